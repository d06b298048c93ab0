#pragma once

#include <span>

#include "engine/accel/layout_bvh2q.h"
#include "engine/accel/walk_binary.h"

namespace raylab {

/// What a ray meets in a node, whose boxes are on the grid that `slab` stands for.
inline BinaryStep stepBvh2q(const NodeBvh2q& node, const GridSlab& slab, float tMin, float tMax) {
    const auto hits = [&](const uint32_t(&box)[3], float& tNear) {
        const glm::uvec3 words(box[0], box[1], box[2]);
        return slabHit(slab.at(words & 0xffffu), slab.at(words >> 16u), tMin, tMax, tNear);
    };
    BinaryStep step{false, false, 0.0f, 0.0f, node.child0, node.child1};
    step.hit0 = hits(node.box0, step.t0);
    step.hit1 = hits(node.box1, step.t1);
    return step;
}

/// Walks the tree near child first and calls `leaf(first, count)` for the leaves that the ray (o, d; any length)
/// reaches between tMin >= 0 and tMax. `leaf` shortens the ray by lowering the same tMax; an any-hit walk ends with
/// tMax below tMin. nodes[0] is the root, `nodeBase` what flattenBvh2q() was given. Returns the largest number of
/// references that were on the stack. Does nothing for a tree without nodes.
template <class LeafFn>
uint32_t walkBvh2q(std::span<const NodeBvh2q> nodes, const Grid& grid, uint32_t nodeBase, const glm::vec3& o,
                   const glm::vec3& d, float tMin, float& tMax, LeafFn&& leaf) {
    if (nodes.empty()) return 0;
    const GridSlab slab(grid.origin, grid.step, o, slabReciprocal(d));
    const auto step = [&](uint32_t reference) { return stepBvh2q(nodes[reference - nodeBase], slab, tMin, tMax); };
    return walkBinary(nodeBase, step, leaf);
}

/// The same over words: see walkBvh2().
template <class LeafFn>
uint32_t walkBvh2q(const FlatTree& tree, uint32_t nodeBase, const glm::vec3& o, const glm::vec3& d, float tMin,
                   float& tMax, LeafFn&& leaf) {
    if (tree.root == kEndOfWalk) return 0;
    const GridSlab slab(tree.grid.origin, tree.grid.step, o, slabReciprocal(d));
    const auto step = [&](uint32_t reference) {
        return stepBvh2q(loadNode<NodeBvh2q>(tree, reference - nodeBase), slab, tMin, tMax);
    };
    return walkBinary(tree.root, step, leaf);
}

}  // namespace raylab
