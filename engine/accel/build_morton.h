#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/accel/build_range.h"

namespace raylab {

/// The indices of `refs` in the order of their centroids along a Morton curve of ten bits an axis, cells cubic; more
/// than a few centroids in one cell are sorted again by a finer curve inside their own box, and so on, so that a small
/// thing in a large world is sorted as well as on its own. Equal ones in order. In parallel; the result does not depend
/// on the number of threads. `centroids2` is the box of twice the centroids.
std::vector<uint32_t> mortonOrder(std::span<const PrimitiveRef> refs, const Box4& centroids2);

}  // namespace raylab
