#pragma once

#include <span>

#include "engine/accel/bvh.h"

namespace raylab {

/// Gives all nodes the boxes of primitives that moved, from the leaves up, in parallel; the tree stays as it is.
/// `bounds` are of the primitives that the tree was built over, by id. A primitive whose box is no longer usable() is
/// not looked at, and a leaf of no others keeps the box that it had. The parts of triangles in a `spatial` tree get
/// whole boxes: right, but larger. The result does not depend on the number of threads.
void refit(Bvh& bvh, std::span<const Aabb> bounds);

}  // namespace raylab
