#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/accel/aabb.h"

namespace raylab {

/// The box of each triangle, in parallel. A triangle that no ray can hit gets an empty box, so that builders leave it
/// out: two equal indices, an index past the end, zero area (in double precision, from the float positions), a
/// coordinate that is not finite or beyond kLargestCoordinate.
std::vector<Aabb> triangleBounds(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles);

}  // namespace raylab
