#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/accel/layout.h"

namespace raylab {

/// Two children and their boxes in 32 bytes. A box word holds lo in its low and hi in its high 16 bits, for x, y and z.
/// A child reference is the index of a node, or leafReference(). Both children are always there: see flattenBvh2q().
struct NodeBvh2q {
    uint32_t box0[3];
    uint32_t child0;
    uint32_t box1[3];
    uint32_t child1;
};
static_assert(sizeof(NodeBvh2q) == 32);

/// What a kernel walks. nodes[0] is the root; no primitives: no nodes, which the caller checks.
struct TreeBvh2q {
    std::vector<NodeBvh2q> nodes;
    Grid grid;
    uint32_t depth = 0;  ///< references that a traversal stack holds at most
};

/// Flattens a binary tree as flattenBinary() says. Boxes are rounded outwards by one step more than needed, which
/// covers the rounding of (origin - O) + q * step in the kernel. References are absolute: `nodeBase` and
/// `primitiveBase` are where nodes[0] and Bvh::order[0] will be. Throws Error where they exceed 31 and 27 bits.
TreeBvh2q flattenBvh2q(const Bvh& bvh, uint32_t nodeBase, uint32_t primitiveBase);

/// The same as words: see flatten().
FlatTree flattenTreeBvh2q(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase);

}  // namespace raylab
