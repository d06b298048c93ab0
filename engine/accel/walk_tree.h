#pragma once

#include <string_view>

#include "engine/accel/walk_bvh2.h"
#include "engine/accel/walk_bvh2q.h"
#include "engine/accel/walk_bvh4b.h"
#include "engine/accel/walk_bvh4q.h"
#include "engine/accel/walk_bvh8q.h"
#include "engine/core/error.h"

namespace raylab {

/// The walk of any of layouts(): see walkBvh2(). Throws Error for a layout that is not there.
template <class LeafFn>
uint32_t walkTree(std::string_view layout, const FlatTree& tree, uint32_t nodeBase, const glm::vec3& o,
                  const glm::vec3& d, float tMin, float& tMax, LeafFn&& leaf) {
    if (layout == "bvh2") return walkBvh2(tree, nodeBase, o, d, tMin, tMax, leaf);
    if (layout == "bvh2q") return walkBvh2q(tree, nodeBase, o, d, tMin, tMax, leaf);
    if (layout == "bvh4q") return walkBvh4q(tree, nodeBase, o, d, tMin, tMax, leaf);
    if (layout == "bvh4b") return walkBvh4b(tree, nodeBase, o, d, tMin, tMax, leaf);
    if (layout == "bvh8q") return walkBvh8q(tree, nodeBase, o, d, tMin, tMax, leaf);
    throw Error("there is no layout '" + std::string(layout) + "'");
}

}  // namespace raylab
