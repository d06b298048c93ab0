#pragma once

#include <cstdint>
#include <vector>

#include "engine/scene/scene.h"

namespace raylab {

/// For each triangle of a mesh, two bits for each of the 16 equal triangles that it is cut into (kOpacity... in
/// shaders/shared/scene.h, which names the paper; numbered as opacityAt() in shaders/trace/candidate.glsl does): whether the
/// alpha test passes, or fails, wherever a hit lies in it. Exact: every texel that the bilinear lookup can reach is looked at,
/// with some slack for rounding. What a hit would have to look up the texture for stays unknown.
std::vector<uint32_t> opacityMaps(const Scene& scene, const Mesh& mesh);

}  // namespace raylab
