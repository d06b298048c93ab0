#pragma once

#include <algorithm>
#include <bit>

#include "engine/accel/layout_bvh8q.h"
#include "engine/accel/walk_binary.h"

namespace raylab {

/// What a ray meets in a node: bits 24 to 31 inner children, by slot ^ 7 ^ r (see NodeBvh8q), so that the nearest one
/// is the highest; bits 0 to 23 the node's primitives. `flip` is 7 ^ r.
inline uint32_t stepBvh8q(const NodeBvh8q& node, const glm::vec3& o, const glm::vec3& reciprocal, uint32_t flip,
                          float tMin, float tMax) {
    const GridSlab slab(node.origin, frameStep(node.exponentsInner), o, reciprocal);
    uint32_t hits = 0;
    for (uint32_t slot = 0; slot < 8; ++slot) {
        const auto byte = [&](const uint32_t(&words)[2]) { return (words[slot / 4] >> (8 * (slot % 4))) & 255u; };
        const glm::uvec3 lo(byte(node.loX), byte(node.loY), byte(node.loZ));
        const glm::uvec3 hi(byte(node.hiX), byte(node.hiY), byte(node.hiZ));
        float tNear = 0.0f;
        if (!slabHit(slab.at(lo), slab.at(hi), tMin, tMax, tNear)) continue;
        const uint32_t meta = byte(node.meta);
        const bool inner = ((node.exponentsInner >> (24 + slot)) & 1u) != 0;
        hits |= (meta >> 5) << ((meta & 31u) ^ (inner ? flip : 0u));
    }
    return hits;
}

/// As walkBvh2(). The primitives of a node come before its inner children; an entry of the stack is a group of two
/// uints, and all that is left of a node (Ylitie, Karras and Laine 2017, algorithm 1).
template <class LeafFn>
uint32_t walkBvh8q(const FlatTree& tree, uint32_t nodeBase, const glm::vec3& o, const glm::vec3& d, float tMin,
                   float& tMax, LeafFn&& leaf) {
    if (tree.root == kEndOfWalk) return 0;
    const glm::vec3 reciprocal = slabReciprocal(d);
    const uint32_t flip = 7u ^ ((reciprocal.x < 0.0f ? 1u : 0u) | (reciprocal.y < 0.0f ? 2u : 0u) |
                                (reciprocal.z < 0.0f ? 4u : 0u));
    /// `hits`: inner children as in stepBvh8q(); bits 0 to 7: which slots are inner.
    struct Group {
        uint32_t firstChild;
        uint32_t hits;
    };
    Group stack[kMaxBvhDepth + 4];
    uint32_t size = 0;
    uint32_t highWater = 0;
    Group group{tree.root, 1u << 31};
    while (true) {
        const auto bit = static_cast<uint32_t>(31 - std::countl_zero(group.hits));
        const uint32_t slot = (bit - 24) ^ flip;
        const auto before = static_cast<uint32_t>(std::popcount(group.hits & ((1u << slot) - 1) & 255u));
        group.hits ^= 1u << bit;
        assert(size < std::size(stack));
        if ((group.hits >> 24) != 0) stack[size++] = group;
        highWater = std::max(highWater, size);
        const auto node = loadNode<NodeBvh8q>(tree, group.firstChild + before - nodeBase);
        const uint32_t hits = stepBvh8q(node, o, reciprocal, flip, tMin, tMax);
        for (uint32_t left = hits & 0x00ffffffu; left != 0; left &= left - 1)
            leaf(node.firstSlot + static_cast<uint32_t>(std::countr_zero(left)), 1);
        group = {node.firstChild, (hits & 0xff000000u) | (node.exponentsInner >> 24)};
        if ((hits >> 24) != 0) continue;
        if (size == 0) return 2 * highWater;
        group = stack[--size];
    }
}

}  // namespace raylab
