#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/scene/import.h"
#include "tests/support/draw_bsdf.h"
#include "tests/support/gpu_test.h"
#include "tests/support/paths.h"

/// Every material of `materials` in the furnace: what one scattering leaves of the light, from three directions above
/// and, of what lets light through, below.
namespace raylab::support {
namespace {

using MaterialFurnace = GpuTest;

constexpr uint32_t kDraws = 1u << 15;
/// Of the tables of directional albedos: 5e-3 at most, 3e-4 in the mean.
constexpr double kTableError = 2e-3;

struct Left {
    double mean = 0.0;  ///< in the channel of most
    double standardError = 0.0;
};

Left leftOf(const BsdfKernel& kernel, const Material& material, glm::vec3 wo) {
    shared::BsdfPush push{};
    push.wo = wo;
    push.mode = shared::kBsdfAlbedo;
    push.count = kDraws;
    push.columns = 1;
    glm::dvec3 sum(0.0), squares(0.0);
    for (const glm::vec4& drawn : kernel.draw(material, push)) {
        const glm::dvec3 weight(drawn);
        sum += weight;
        squares += weight * weight;
    }
    const glm::dvec3 mean = sum / double{kDraws}, variance = squares / double{kDraws} - mean * mean;
    int most = 0;
    for (int c = 1; c < 3; ++c) most = mean[c] > mean[most] ? c : most;
    return {mean[most], std::sqrt(std::max(variance[most], 0.0) / double{kDraws})};
}

/// Its factors alone: textures would only take from them.
Material withoutTextures(Material material) {
    material.baseColorTexture = material.metallicRoughnessTexture = material.normalTexture = kNoTexture;
    material.emissionTexture = kNoTexture;
    material.lobeTextures = {};
    material.emission = glm::vec3(0.0f);
    return material;
}

/// What absorbs nothing: whatever is missing then is the model's loss.
Material white(Material material) {
    material.baseColor = glm::vec3(1.0f);
    material.specularColor = glm::min(material.specularColor, glm::vec3(1.0f));
    return material;
}

TEST_F(MaterialFurnace, NoMaterialGivesBackMoreThanCame) {
    const std::filesystem::path file = binaryFolder() / "assets/materials.glb";
    ASSERT_TRUE(std::filesystem::exists(file)) << file;
    const BsdfKernel kernel(device_);
    std::printf("%-28s %26s   %26s\n", "cosine", "as it is: .95 .5 .1 -.5", "white: .95 .5 .1 -.5");
    double least = 1.0;
    for (const Material& imported : importScene(file).materials) {
        const Material own = withoutTextures(imported);
        std::string row;
        for (const bool isWhite : {false, true}) {
            const Material material = isWhite ? white(own) : own;
            for (const float mu : {0.95f, 0.5f, 0.1f, -0.5f}) {
                if (mu < 0.0f && material.transmission <= 0.0f) {
                    row += "      -";
                    continue;
                }
                const Left left = leftOf(kernel, material, {std::sqrt(1.0f - mu * mu), mu, 0.0f});
                char number[16];
                std::snprintf(number, sizeof(number), " %.4f", left.mean);
                row += number;
                EXPECT_LE(left.mean, 1.0 + 4.0 * left.standardError + kTableError)
                    << material.name << ", cosine " << mu;
                if (isWhite) least = std::min(least, left.mean);
            }
            row += "  ";
        }
        std::printf("%-28s %s\n", own.name.c_str(), row.c_str());
    }
    std::printf("white and yet the least: %.4f\n", least);
}

}  // namespace
}  // namespace raylab::support
