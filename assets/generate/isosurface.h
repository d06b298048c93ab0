#pragma once

#include <functional>

#include "assets/generate/mesh_tools.h"

namespace raylab::assets {

struct IsosurfaceConfig {
    glm::vec3 low{-1.0f};
    glm::vec3 high{1.0f};
    float cell = 0.01f;      ///< edge of a grid cell, metres
    float lipschitz = 1.5f;  ///< |distance(p) - distance(q)| <= lipschitz * |p - q|; too small a bound loses pieces
};

/// Polygonises distance = 0 (negative inside) by naive surface nets: one vertex a cell that the surface crosses, at the
/// mean of its edge crossings (Gibson, "Constrained Elastic Surface Nets", MICCAI 1998). `distance` is called from
/// several threads. uv is (0, 0). The surface must stay inside the box, or it is left open there.
Geometry polygonise(const IsosurfaceConfig& config, const std::function<float(glm::vec3)>& distance);

}  // namespace raylab::assets
