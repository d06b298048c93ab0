#pragma once

#include "engine/accel/layout_bvh2.h"
#include "engine/accel/walk_binary.h"

namespace raylab {

/// Calls `leaf(first, count)` for the leaves that the ray (o, d; any length) reaches between tMin >= 0 and tMax, near
/// child first. `leaf` shortens the ray by lowering the same tMax; an any-hit walk ends with tMax below tMin.
/// `nodeBase` is what flatten() was given. Returns the most entries that were on the stack. Does nothing for a tree
/// without nodes.
template <class LeafFn>
uint32_t walkBvh2(const FlatTree& tree, uint32_t nodeBase, const glm::vec3& o, const glm::vec3& d, float tMin,
                  float& tMax, LeafFn&& leaf) {
    if (tree.root == kEndOfWalk) return 0;
    const glm::vec3 reciprocal = slabReciprocal(d);
    const auto hits = [&](const glm::vec3& lo, const glm::vec3& hi, float& tNear) {
        return slabHit((lo - o) * reciprocal, (hi - o) * reciprocal, tMin, tMax, tNear);
    };
    const auto step = [&](uint32_t reference) {
        const auto node = loadNode<NodeBvh2>(tree, reference - nodeBase);
        BinaryStep result{false, false, 0.0f, 0.0f, node.child0, node.child1};
        result.hit0 = hits(node.lo0, node.hi0, result.t0);
        result.hit1 = hits(node.lo1, node.hi1, result.t1);
        return result;
    };
    return walkBinary(tree.root, step, leaf);
}

}  // namespace raylab
