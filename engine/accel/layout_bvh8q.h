#pragma once

#include "engine/accel/layout.h"
#include "engine/accel/layout_frame.h"

namespace raylab {

/// Eight children in 80 bytes, five uvec4s: the compressed wide BVH of Ylitie, Karras and Laine, "Efficient Incoherent
/// Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017, figure 1. A child's slot is chosen so that a ray
/// whose direction is negative on the axes of r (bit 0: x, 1: y, 2: z) meets the children in rising order of slot ^ r.
struct NodeBvh8q {
    glm::vec3 origin;
    uint32_t exponentsInner;  ///< LocalFrame::exponents; from bit 24 on a bit a slot: is inner
    uint32_t firstChild;      ///< inner children follow it in order of slots
    uint32_t firstSlot;       ///< of the primitives of all leaves
    /// A byte a slot. Empty: 0. Inner: 001 in the high bits, 24 + slot below. Leaf: as many ones as primitives in the
    /// high three bits, from the lowest on, and its first primitive from firstSlot on below.
    uint32_t meta[2];
    uint32_t loX[2];  ///< a byte a slot
    uint32_t loY[2];
    uint32_t loZ[2];
    uint32_t hiX[2];
    uint32_t hiY[2];
    uint32_t hiZ[2];
};
static_assert(sizeof(NodeBvh8q) == 80);

constexpr int kWidthBvh8q = 8;

/// Leaves hold up to 3 primitives, a node up to 24. See flatten() and WideCollapse.
FlatTree flattenTreeBvh8q(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase);

}  // namespace raylab
