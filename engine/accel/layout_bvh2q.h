#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/accel/bvh.h"

namespace raylab {

/// Positions as 16-bit integers: coordinate = origin + q * step. The step is positive on each axis, of flat trees too.
struct Grid {
    glm::vec3 origin{0.0f};
    glm::vec3 step{1.0f};
};

/// Two children and their boxes in 32 bytes. A box word holds lo in its low and hi in its high 16 bits, for x, y and z.
/// A child reference is the index of a node, or leafReference(). Both children are always there: see flattenBvh2q().
struct NodeBvh2q {
    uint32_t box0[3];
    uint32_t child0;
    uint32_t box1[3];
    uint32_t child1;
};
static_assert(sizeof(NodeBvh2q) == 32);

constexpr uint32_t kLeafBit = 0x80000000u;

/// Bit 31 set, bits 27 to 30 count - 1, bits 0 to 26 the first primitive slot.
constexpr uint32_t leafReference(uint32_t first, uint32_t count) { return kLeafBit | ((count - 1) << 27) | first; }
constexpr bool isLeafReference(uint32_t reference) { return (reference & kLeafBit) != 0; }
constexpr uint32_t leafFirst(uint32_t reference) { return reference & 0x07ffffffu; }
constexpr uint32_t leafCount(uint32_t reference) { return ((reference >> 27) & 15u) + 1; }

/// What a kernel walks. nodes[0] is the root; no primitives: no nodes, which the caller checks.
struct TreeBvh2q {
    std::vector<NodeBvh2q> nodes;
    Grid grid;
    uint32_t depth = 0;  ///< references that a traversal stack holds at most
};

/// Flattens a binary tree: an inner node becomes a NodeBvh2q, children that are inner nodes stay neighbours, depth
/// first. Boxes are rounded outwards by one step more than needed, which covers the rounding of (origin - O) + q * step
/// in the kernel. A tree of one leaf gets a node over its two halves; of one primitive, over that primitive twice, as
/// testing it again is harmless and an absent child's box could be hit by a min/max slab test. References are absolute:
/// `nodeBase` and `primitiveBase` are where nodes[0] and Bvh::order[0] will be. Throws Error where they exceed 31 and
/// 27 bits.
TreeBvh2q flattenBvh2q(const Bvh& bvh, uint32_t nodeBase, uint32_t primitiveBase);

}  // namespace raylab
