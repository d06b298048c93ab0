#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "engine/accel/layout_bvh4q.h"
#include "engine/accel/walk_binary.h"

namespace raylab {

/// Children of one node that are still to be visited, nearest first, in one uint: bits 6 to 30 the first inner child,
/// bits 0 to 5 up to three of them by their number of two bits each; where one repeats, the list ended before it.
constexpr uint32_t groupBvh4q(uint32_t firstChild, uint32_t a, uint32_t b, uint32_t c) {
    return (firstChild << 6) | (c << 4) | (b << 2) | a;
}
constexpr uint32_t groupNext(uint32_t group) { return (group >> 6) + (group & 3u); }
constexpr bool groupIsLast(uint32_t group) { return (group & 3u) == ((group >> 2) & 3u); }
constexpr uint32_t groupRest(uint32_t group) {
    return (group & ~63u) | ((group >> 2) & 15u) | (group & (3u << 4));
}

constexpr uint32_t kNoKey = 0xffffffffu;

/// Children that a ray meets, nearest first: a key is the bits of the distance with the child's number in the lowest
/// two; kNoKey: no more of them.
using KeysBvh4q = std::array<uint32_t, 4>;

inline uint32_t keyChild(uint32_t key) { return key & 3u; }
inline float keyDistance(uint32_t key) { return std::bit_cast<float>(key & ~3u); }

struct StepBvh4q {
    KeysBvh4q inner;
    KeysBvh4q leaves;
};

inline StepBvh4q stepBvh4q(const NodeBvh4q& node, const glm::vec3& o, const glm::vec3& reciprocal, float tMin,
                           float tMax) {
    const GridSlab slab(node.origin, frameStep(node.exponents), o, reciprocal);
    StepBvh4q step{{kNoKey, kNoKey, kNoKey, kNoKey}, {kNoKey, kNoKey, kNoKey, kNoKey}};
    for (uint32_t child = 0; child < 4; ++child) {
        const glm::uvec3 lo(node.lo[0], node.lo[1], node.lo[2]);
        const glm::uvec3 hi(node.hi[0], node.hi[1], node.hi[2]);
        const uint32_t shift = 8 * child;
        float tNear = 0.0f;
        const bool hit =
            slabHit(slab.at((lo >> shift) & 255u), slab.at((hi >> shift) & 255u), tMin, tMax, tNear);
        if (!hit || ((node.childExists >> (28 + child)) & 1u) == 0) continue;
        const uint32_t key = (std::bit_cast<uint32_t>(tNear) & ~3u) | child;
        (((node.slotInner >> (28 + child)) & 1u) != 0 ? step.inner : step.leaves)[child] = key;
    }
    std::sort(step.inner.begin(), step.inner.end());
    std::sort(step.leaves.begin(), step.leaves.end());
    return step;
}

/// The leaf that child `child` of a node is.
inline uint32_t leafBvh4q(const NodeBvh4q& node, uint32_t child) {
    uint32_t first = node.slotInner & 0x0fffffffu;
    const uint32_t inner = node.slotInner >> 28;
    for (uint32_t i = 0; i < child; ++i)
        first += ((inner >> i) & 1u) != 0 ? 0u : ((node.exponents >> (24 + 2 * i)) & 3u) + 1;
    return leafReference(first, ((node.exponents >> (24 + 2 * child)) & 3u) + 1);
}

/// As walkBvh2(). Leaves of a node come before its inner children, each nearest first; one entry of the stack holds all
/// that is left of a node.
template <class LeafFn>
uint32_t walkBvh4q(const FlatTree& tree, uint32_t nodeBase, const glm::vec3& o, const glm::vec3& d, float tMin,
                   float& tMax, LeafFn&& leaf) {
    const glm::vec3 reciprocal = slabReciprocal(d);
    uint32_t stack[kMaxBvhDepth + 4];
    stack[0] = kEndOfWalk;
    uint32_t top = 0;
    uint32_t highWater = 0;
    uint32_t reference = tree.root;
    while (reference != kEndOfWalk) {
        const auto node = loadNode<NodeBvh4q>(tree, reference - nodeBase);
        const StepBvh4q step = stepBvh4q(node, o, reciprocal, tMin, tMax);
        const KeysBvh4q& inner = step.inner;
        const uint32_t firstChild = node.childExists & 0x0fffffffu;
        if (inner[0] != kNoKey) {
            reference = firstChild + keyChild(inner[0]);
            const uint32_t a = keyChild(inner[1]);
            const uint32_t b = inner[2] != kNoKey ? keyChild(inner[2]) : a;
            const uint32_t c = inner[3] != kNoKey ? keyChild(inner[3]) : b;
            assert(top + 1 < std::size(stack));
            if (inner[1] != kNoKey) stack[++top] = groupBvh4q(firstChild, a, b, c);
            highWater = std::max(highWater, top);
        } else if (const uint32_t group = stack[top]; group == kEndOfWalk) {
            reference = kEndOfWalk;
        } else {
            reference = groupNext(group);
            stack[top] = groupRest(group);
            top -= groupIsLast(group) ? 1 : 0;
        }
        for (const uint32_t key : step.leaves) {
            if (key == kNoKey || keyDistance(key) > tMax * kSlabPad) break;
            const uint32_t found = leafBvh4q(node, keyChild(key));
            leaf(leafFirst(found), leafCount(found));
        }
    }
    return highWater;
}

}  // namespace raylab
