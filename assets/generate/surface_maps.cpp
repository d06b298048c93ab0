#include "assets/generate/surface_maps.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace raylab::assets {
namespace {

uint32_t toByte(float value) { return static_cast<uint32_t>(glm::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f); }

/// `texel(x, y)` returns red, green, blue and alpha.
template <typename Texel>
SurfaceMap mapOf(uint32_t size, Texel&& texel) {
    SurfaceMap map{.size = size, .texels = {}};
    map.texels.reserve(static_cast<size_t>(size) * size);
    for (uint32_t y = 0; y < size; ++y) {
        for (uint32_t x = 0; x < size; ++x) {
            const glm::vec4 value = texel(x, y);
            map.texels.push_back(toByte(value.x) | toByte(value.y) << 8 | toByte(value.z) << 16 |
                                 toByte(value.w) << 24);
        }
    }
    return map;
}

}  // namespace

SurfaceMaps paintSurface(const PaintConfig& config, const std::function<SurfacePoint(glm::vec2)>& paint) {
    const uint32_t size = config.size;
    std::vector<SurfacePoint> points(static_cast<size_t>(size) * size);
    tbb::parallel_for(0u, size, [&](uint32_t y) {
        for (uint32_t x = 0; x < size; ++x) {
            points[static_cast<size_t>(y) * size + x] = paint((glm::vec2(x, y) + 0.5f) / static_cast<float>(size));
        }
    });
    const auto at = [&](uint32_t x, uint32_t y) -> const SurfacePoint& {
        return points[static_cast<size_t>(y % size) * size + x % size];
    };
    const float twoTexels = 2.0f * config.metres / static_cast<float>(size);
    const auto normalAt = [&](uint32_t x, uint32_t y) {
        const float right = (at(x + 1, y).height - at(x + size - 1, y).height) / twoTexels;
        const float down = (at(x, y + 1).height - at(x, y + size - 1).height) / twoTexels;
        return glm::normalize(glm::vec3(-right, down, 1.0f)) * 0.5f + 0.5f;
    };

    SurfaceMaps maps;
    const auto makeColour = [&] {
        maps.baseColor = mapOf(size, [&](uint32_t x, uint32_t y) {
            return glm::vec4(at(x, y).colour, config.alpha ? at(x, y).alpha : 1.0f);
        });
    };
    const auto makeRoughness = [&] {
        if (!config.roughness) return;
        maps.metallicRoughness = mapOf(
            size, [&](uint32_t x, uint32_t y) { return glm::vec4(1.0f, at(x, y).roughness, at(x, y).metallic, 1.0f); });
    };
    const auto makeNormals = [&] {
        if (config.relief)
            maps.normal = mapOf(size, [&](uint32_t x, uint32_t y) { return glm::vec4(normalAt(x, y), 1.0f); });
    };
    tbb::parallel_invoke(makeColour, makeRoughness, makeNormals);
    return maps;
}

}  // namespace raylab::assets
