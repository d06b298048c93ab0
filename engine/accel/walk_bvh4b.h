#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "engine/accel/layout_bvh4b.h"
#include "engine/accel/walk_bvh4q.h"

namespace raylab {

/// Children of one node that are still to be visited, in one uint: from bit 7 on the node's first child, below their
/// numbers, two bits each, the next one lowest, ended by a bit that is 1.
constexpr uint32_t kNoChildrenBvh4b = 1;
constexpr bool hasChildrenBvh4b(uint32_t group) { return (group & 127u) != kNoChildrenBvh4b; }
constexpr uint32_t groupNextBvh4b(uint32_t group) { return (group >> 7) + (group & 3u); }
constexpr uint32_t groupRestBvh4b(uint32_t group) { return (group & ~127u) | ((group & 127u) >> 2); }

/// The children that a ray meets, nearest first, as the low bits of a group, of up to four.
inline uint32_t childrenBvh4b(const NodeBvh4b& node, const glm::vec3& o, const glm::vec3& reciprocal, float tMin,
                              float tMax) {
    const GridSlab slab(node.origin, frameStep(node.head), o, reciprocal);
    KeysBvh4q keys{kNoKey, kNoKey, kNoKey, kNoKey};
    for (uint32_t child = 0; child <= ((node.head >> 24) & 3u); ++child) {
        const auto planes = [&](uint32_t i) {
            return glm::uvec3(node.planes[i], node.planes[i + 2], node.planes[i + 4]) >> (8 * child) & 255u;
        };
        float tNear = 0.0f;
        if (slabHit(slab.at(planes(0)), slab.at(planes(1)), tMin, tMax, tNear))
            keys[child] = (std::bit_cast<uint32_t>(tNear) & ~3u) | child;
    }
    std::sort(keys.begin(), keys.end());
    uint32_t children = kNoChildrenBvh4b;
    for (size_t i = keys.size(); i-- > 0;)
        if (keys[i] != kNoKey) children = children << 2 | keyChild(keys[i]);
    return children;
}

/// As walkBvh2(). Each leaf is one slot. `tree` must not yet hold what a kernel wants of primitives.
template <class LeafFn>
uint32_t walkBvh4b(const FlatTree& tree, uint32_t nodeBase, const glm::vec3& o, const glm::vec3& d, float tMin,
                   float& tMax, LeafFn&& leaf) {
    if (tree.root == kEndOfWalk) return 0;
    const glm::vec3 reciprocal = slabReciprocal(d);
    uint32_t stack[kMaxBvhDepth + 2];
    uint32_t size = 0;
    uint32_t highWater = 0;
    uint32_t group = kNoChildrenBvh4b;
    uint32_t block = tree.root;
    while (true) {
        const auto node = loadNode<NodeBvh4b>(tree, block - nodeBase);
        if (isLeafReference(node.head)) {
            leaf(node.head & ~kLeafBit, 1u);
        } else if (const uint32_t children = childrenBvh4b(node, o, reciprocal, tMin, tMax);
                   children != kNoChildrenBvh4b) {
            assert(size < std::size(stack));
            if (hasChildrenBvh4b(group)) stack[size++] = group;
            highWater = std::max(highWater, size);
            block = node.firstChild + (children & 3u);
            group = node.firstChild << 7 | children >> 2;
            continue;
        }
        if (!hasChildrenBvh4b(group)) {
            if (size == 0) return highWater;
            group = stack[--size];
        }
        block = groupNextBvh4b(group);
        group = groupRestBvh4b(group);
    }
}

}  // namespace raylab
