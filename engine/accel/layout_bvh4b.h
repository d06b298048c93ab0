#pragma once

#include "engine/accel/layout.h"

namespace raylab {

constexpr int kWidthBvh4b = 4;
constexpr uint32_t kWordsBvh4b = 3;
constexpr uint32_t kMaxBlocksBvh4b =
    (1u << 25) - 1;  ///< a group on the stack has 25 bits for a block; the last one ends a walk

/// A tree of equal blocks: an inner node with up to four children, or one primitive. The children of a node are
/// neighbours, whatever they are; a block says itself which it is, so that a walk fetches nodes and primitives in the
/// same step. 8-bit boxes in a local frame (layout_frame.h).
struct NodeBvh4b {
    glm::vec3 origin;
    uint32_t head;       ///< three biased exponents of 8 bits, from bit 24 on the children - 1
    uint32_t planes[6];  ///< lo and hi of x, y and z, a byte a child
    uint32_t firstChild;
    uint32_t padding;
};
static_assert(sizeof(NodeBvh4b) == 16 * kWordsBvh4b);

/// See flatten(). Of a block that is a primitive, only the last component of the first word is written: kLeafBit |
/// slot. What the kernel wants there is for the caller to fill in. `nodeBase` counts blocks. A block is `blockWords`
/// words, at least kWordsBvh4b.
FlatTree flattenTreeBvh4b(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase, uint32_t blockWords = kWordsBvh4b);

}  // namespace raylab
