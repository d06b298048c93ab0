#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/accel/aabb.h"

namespace raylab {

/// Ids of the usable() boxes in an order of which a tree by plain halving is a good one: the first half (the larger by
/// one where the count is odd) and the second half of every range are apart along the axis that the SAH prefers. For
/// drivers that build their trees like that over primitives as they come (Mesa's lavapipe up to 25.0).
/// The result does not depend on the number of threads.
std::vector<uint32_t> halvingOrder(std::span<const Aabb> bounds);

}  // namespace raylab
