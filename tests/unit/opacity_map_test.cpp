#include "engine/render/opacity_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "shaders/shared/scene.h"

/// Opacity maps against the bilinear lookup that a hit would do, in double precision.
namespace raylab {
namespace {

using Engine = std::mt19937;

double uniform(Engine& engine, double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(engine); }

/// glTF's wrap modes, by their definition: reflect or repeat until inside.
uint32_t wrapped(int64_t x, uint32_t size, Wrap wrap) {
    const auto n = static_cast<int64_t>(size);
    if (wrap == Wrap::clamp) return static_cast<uint32_t>(std::clamp<int64_t>(x, 0, n - 1));
    while (x < 0 || x >= n) {
        if (wrap == Wrap::repeat) x += x < 0 ? n : -n;
        if (wrap == Wrap::mirror) x = x < 0 ? -1 - x : 2 * n - 1 - x;
    }
    return static_cast<uint32_t>(x);
}

double bilinearAlpha(const Texture& texture, const glm::dvec2& uv) {
    const glm::dvec2 at = uv * glm::dvec2(texture.width, texture.height) - 0.5;
    const glm::dvec2 cell = glm::floor(at), f = at - cell;
    const auto alpha = [&](int64_t dx, int64_t dy) {
        const uint32_t x = wrapped(static_cast<int64_t>(cell.x) + dx, texture.width, texture.wrapU);
        const uint32_t y = wrapped(static_cast<int64_t>(cell.y) + dy, texture.height, texture.wrapV);
        return static_cast<double>(texture.texels[size_t{y} * texture.width + x] >> 24) / 255.0;
    };
    return glm::mix(glm::mix(alpha(0, 0), alpha(1, 0), f.x), glm::mix(alpha(0, 1), alpha(1, 1), f.x), f.y);
}

/// Blobs, so that some microtriangles are all of one kind.
Texture blobs(Engine& engine, uint32_t width, uint32_t height, Wrap wrapU, Wrap wrapV) {
    Texture texture;
    texture.width = width;
    texture.height = height;
    texture.wrapU = wrapU;
    texture.wrapV = wrapV;
    const double frequency = uniform(engine, 2.0, 9.0), phase = uniform(engine, 0.0, 6.0);
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x) {
            const double wave =
                std::sin(frequency * x / width + phase) + std::sin(frequency * y / height + 2.0 * phase);
            texture.texels.push_back(static_cast<uint32_t>(std::clamp(127.5 + 300.0 * wave, 0.0, 255.0)) << 24);
        }
    return texture;
}

/// A scene of one mesh of `count` separate triangles with random texture coordinates.
Scene randomScene(Engine& engine, const Texture& texture, AlphaMode mode, size_t count) {
    Scene scene;
    scene.textures.push_back(texture);
    Material material;
    material.alphaMode = mode;
    material.alphaCutoff = static_cast<float>(uniform(engine, 0.2, 0.8));
    material.baseColorTexture = 0;
    scene.materials.push_back(material);
    Mesh mesh;
    const double size = std::pow(10.0, uniform(engine, -1.5, 0.5));
    for (uint32_t i = 0; i < count; ++i) {
        const glm::dvec2 centre(uniform(engine, -3.0, 3.0), uniform(engine, -3.0, 3.0));
        for (uint32_t corner = 0; corner < 3; ++corner) {
            mesh.positions.emplace_back(0.0f);
            mesh.uvs.emplace_back(centre + size * glm::dvec2(uniform(engine, -1.0, 1.0), uniform(engine, -1.0, 1.0)));
        }
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    scene.meshes.push_back(mesh);
    return scene;
}

struct Tally {
    size_t opaque = 0, transparent = 0, wrong = 0;
};

/// Looks up random points of every triangle; `wrong`: those that the map says the opposite of.
Tally lookUp(Engine& engine, const Scene& scene) {
    const Mesh& mesh = scene.meshes[0];
    const Material& material = scene.materials[0];
    const std::vector<uint32_t> maps = opacityMaps(scene, mesh);
    Tally tally;
    for (size_t i = 0; i < maps.size(); ++i)
        for (int sample = 0; sample < 400; ++sample) {
            double u = uniform(engine, 0.0, 1.0), v = uniform(engine, 0.0, 1.0);
            if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
            const int row = std::min(3, static_cast<int>(4.0 * u)), column = std::min(3, static_cast<int>(4.0 * v));
            const bool turned = 4.0 * u - row + 4.0 * v - column > 1.0;
            int index = 2 * column + (turned ? 1 : 0);
            for (int before = 0; before < row; ++before) index += 7 - 2 * before;
            const uint32_t opacity = (maps[i] >> (2 * index)) & 3u;
            const glm::uvec3 t = mesh.triangles[i];
            const glm::dvec2 uv0(mesh.uvs[t.x]), uv1(mesh.uvs[t.y]), uv2(mesh.uvs[t.z]);
            const double alpha = bilinearAlpha(scene.textures[0], uv0 + u * (uv1 - uv0) + v * (uv2 - uv0));
            const bool blend = material.alphaMode == AlphaMode::blend;
            const double cutoff = static_cast<double>(material.alphaCutoff);
            tally.opaque += opacity == shared::kOpacityOpaque ? 1 : 0;
            tally.transparent += opacity == shared::kOpacityTransparent ? 1 : 0;
            const bool passes = blend ? alpha > 1.0 - 1e-9 : alpha >= cutoff;
            const bool fails = blend ? alpha < 1e-9 : alpha < cutoff;
            tally.wrong +=
                (opacity == shared::kOpacityOpaque && !passes) || (opacity == shared::kOpacityTransparent && !fails);
        }
    return tally;
}

TEST(OpacityMap, SaysWhatTheLookupSays) {
    constexpr uint32_t kSeed = 7;
    Engine engine(kSeed);
    Tally all;
    for (const Wrap wrapU : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
        for (const Wrap wrapV : {Wrap::repeat, Wrap::clamp, Wrap::mirror})
            for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend})
                for (const uint32_t width : {1u, 5u, 64u}) {
                    const Texture texture = blobs(engine, width, 48, wrapU, wrapV);
                    const Tally tally = lookUp(engine, randomScene(engine, texture, mode, 100));
                    EXPECT_EQ(tally.wrong, 0u) << "seed " << kSeed << ", wrap " << static_cast<int>(wrapU) << " "
                                               << static_cast<int>(wrapV) << ", width " << width;
                    all.opaque += tally.opaque;
                    all.transparent += tally.transparent;
                }
    // A map that knows nothing would pass; a tenth of the lookups must be spared each way.
    EXPECT_GT(all.opaque, 200'000u);
    EXPECT_GT(all.transparent, 200'000u);
}

TEST(OpacityMap, OpaqueMaterialsNeedNoLookup) {
    Scene scene;
    scene.materials.emplace_back();
    Mesh mesh;
    mesh.triangles.emplace_back(0, 1, 2);
    EXPECT_EQ(opacityMaps(scene, mesh), std::vector<uint32_t>{shared::kAllOpaque});
}

TEST(OpacityMap, ConstantAlphaIsDecidedOnce) {
    Scene scene;
    Material material;
    material.alphaMode = AlphaMode::mask;
    material.alpha = 0.25f;
    scene.materials.push_back(material);
    Mesh mesh;
    mesh.triangles.emplace_back(0, 1, 2);
    EXPECT_EQ(opacityMaps(scene, mesh), std::vector<uint32_t>{0x55555555u});
    scene.materials[0].alphaMode = AlphaMode::blend;
    EXPECT_EQ(opacityMaps(scene, mesh), std::vector<uint32_t>{0u});
}

}  // namespace
}  // namespace raylab
