#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace raylab::assets {

/// What a painted surface is at one point.
struct SurfacePoint {
    glm::vec3 colour{1.0f};  ///< sRGB encoded, 0 to 1
    float alpha = 1.0f;
    float height = 0.0f;  ///< metres outwards
    float roughness = 1.0f;
    float metallic = 0.0f;
};

/// A square image, R in the lowest byte; no texels: not made.
struct SurfaceMap {
    uint32_t size = 0;
    std::vector<uint32_t> texels;
};

/// As glTF wants them: colour with alpha (sRGB), occlusion-roughness-metallic (G, B), tangent-space normals (+Y up).
struct SurfaceMaps {
    SurfaceMap baseColor;
    SurfaceMap metallicRoughness;
    SurfaceMap normal;
};

struct PaintConfig {
    uint32_t size = 512;    ///< texels across, a power of two
    float metres = 1.0f;    ///< what the texture measures on the surface, for slopes
    bool alpha = false;     ///< keep the alpha channel
    bool relief = true;     ///< make the normal map
    bool roughness = true;  ///< make the metallic-roughness map
};

/// Evaluates `paint` at every texel centre (uv in [0, 1]^2, v downwards) and makes the maps asked for. Heights wrap
/// round.
SurfaceMaps paintSurface(const PaintConfig& config, const std::function<SurfacePoint(glm::vec2 uv)>& paint);

}  // namespace raylab::assets
