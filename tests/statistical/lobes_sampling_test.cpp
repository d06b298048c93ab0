#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "tests/support/chi_squared.h"
#include "tests/support/draw_bsdf.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// Every lobe: where its sampler's directions fall against the density that the path tracer weighs them by, which never
/// adds up to more than 1; and f the same both ways.
namespace raylab::support {
namespace {

using Lobes = GpuTest;

struct NamedMaterial {
    const char* name;
    Material material;
};

Material metal(float roughness) {
    Material m;
    m.baseColor = {0.9f, 0.6f, 0.3f};
    m.metallic = 1.0f;
    m.roughness = roughness;
    return m;
}

Material changed(Material m, void (*change)(Material&)) {
    change(m);
    return m;
}

Material cloth() {
    return changed(lambert({0.3f, 0.1f, 0.4f}), [](Material& m) {
        m.sheenColor = {0.9f, 0.7f, 0.5f};
        m.sheenRoughness = 0.5f;
    });
}

Material coatedCloth() {
    return changed(cloth(), [](Material& m) {
        m.specular = 0.8f;
        m.roughness = 0.7f;
        m.specularColor = {1.0f, 0.4f, 0.2f};
        m.clearcoat = 0.7f;
        m.clearcoatRoughness = 0.6f;
    });
}

Material brushed() {
    return changed(metal(0.55f), [](Material& m) {
        m.anisotropy = 0.8f;
        m.anisotropyRotationRadians = 0.6f;
    });
}

Material frosted(bool thin) {
    Material m = glass();
    m.baseColor = {0.9f, 0.8f, 0.7f};
    m.thin = thin;
    m.roughness = 0.65f;
    return m;
}

std::vector<NamedMaterial> opaqueMaterials() {
    return {{"plastic", changed(lambert(0.7f), [](Material& m) { m.specular = 1.0f, m.roughness = 0.6f; })},
            {"metal", metal(0.6f)},
            {"brushed metal", brushed()},
            {"cloth", cloth()},
            {"coated cloth", coatedCloth()}};
}

constexpr uint32_t kColumns = 32, kRows = 32, kSteps = 8;

std::vector<double> binsOf(const BsdfKernel& kernel, const Material& material, glm::vec3 wo) {
    const uint32_t columns = kColumns * kSteps, rows = kRows * kSteps;
    const auto grid = kernel.draw(material, {wo, shared::kBsdfGrid, columns * rows, columns});
    std::vector<double> bins(kColumns * kRows + 1, 0.0);
    for (uint32_t i = 0; i < grid.size(); ++i)
        bins[i / columns / kSteps * kColumns + i % columns / kSteps] +=
            static_cast<double>(grid[i].w) * 4.0 * kPi / (columns * rows);
    double total = 0.0;
    for (const double bin : bins) total += bin;
    EXPECT_LE(total, 1.0005);
    bins.back() = std::max(0.0, 1.0 - total);
    return bins;
}

std::vector<size_t> countsOf(const BsdfKernel& kernel, const Material& material, glm::vec3 wo, uint32_t count) {
    std::vector<size_t> counts(kColumns * kRows + 1, 0);
    for (const glm::vec4& s : kernel.draw(material, {wo, shared::kBsdfSample, count, 1})) {
        const double x = std::atan2(static_cast<double>(s.z), static_cast<double>(s.x)) / (2.0 * kPi) + 0.5;
        const auto column = std::clamp(static_cast<int>(x * kColumns), 0, int{kColumns} - 1);
        const auto row =
            std::clamp(static_cast<int>((0.5 + 0.5 * static_cast<double>(s.y)) * kRows), 0, int{kRows} - 1);
        ++counts[s.w > 0.0f ? static_cast<size_t>(row) * kColumns + static_cast<size_t>(column) : kColumns * kRows];
    }
    return counts;
}

/// A15, with probability .01 to fail at random over all cases (Sidak). The bins' probabilities are good to about 1e-4
/// of themselves, so that more samples would count the rule's own error.
TEST_F(Lobes, AreSampledByTheirDensity) {
    const BsdfKernel kernel(device_);
    std::vector<NamedMaterial> materials = opaqueMaterials();
    materials.push_back({"frosted sheet", frosted(true)});
    materials.push_back({"frosted glass", frosted(false)});
    const glm::vec3 directions[] = {glm::normalize(glm::vec3(0.4f, 1.0f, -0.2f)),
                                    glm::normalize(glm::vec3(-0.8f, 0.5f, 0.6f))};
    const double level = 1.0 - std::pow(1.0 - 0.01, 1.0 / static_cast<double>(2 * materials.size()));
    for (const NamedMaterial& m : materials)
        for (const glm::vec3 wo : directions) {
            const double p = chiSquaredTest(countsOf(kernel, m.material, wo, 1u << 19), binsOf(kernel, m.material, wo));
            std::printf("%-16s p = %.4f\n", m.name, p);
            EXPECT_GT(p, level) << m.name;
        }
}

TEST_F(Lobes, AreReciprocal) {
    const BsdfKernel kernel(device_);
    for (const NamedMaterial& m : opaqueMaterials()) {
        double largest = 0.0;
        for (const glm::vec4& f :
             kernel.draw(m.material, {glm::vec3(0.0f, 1.0f, 0.0f), shared::kBsdfBothWays, 1u << 14, 1})) {
            largest = std::max({largest, static_cast<double>(std::abs(f.x - f.z) / std::max(f.x, 1e-3f)),
                                static_cast<double>(std::abs(f.y - f.w) / std::max(f.y, 1e-3f))});
        }
        std::printf("%-16s differs by %.1e at most\n", m.name, largest);
        EXPECT_LT(largest, 2e-3) << m.name;
    }
}

}  // namespace
}  // namespace raylab::support
