#pragma once

#include "engine/accel/layout.h"
#include "engine/accel/layout_frame.h"

namespace raylab {

/// Four children in 48 bytes, three uvec4s: the compression of Ylitie, Karras and Laine 2017 at half their width. Inner
/// children come first, then leaves; what is left is empty and excluded by `exists`, not by its box.
struct NodeBvh4q {
    glm::vec3 origin;
    uint32_t exponents;  ///< LocalFrame::exponents; from bit 24 on two bits a child: leaf's primitives - 1
    uint32_t lo[3];      ///< x, y, z: a byte a child
    uint32_t hi[3];
    uint32_t childExists;  ///< bits 0 to 27: first inner child, the others follow; from bit 28 on a bit a child: exists
    uint32_t slotInner;    ///< bits 0 to 27: first slot of the first leaf; from bit 28 on a bit a child: is inner
};
static_assert(sizeof(NodeBvh4q) == 48);

constexpr int kWidthBvh4q = 4;
/// An entry of a walk's stack has 25 bits for the first child of a node: see groupBvh4q().
constexpr uint32_t kMaxNodesBvh4q = 1u << 25;

/// Leaves of a node hold up to 4 primitives, its own ones neighbouring slots. See flatten() and WideCollapse.
FlatTree flattenTreeBvh4q(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase);

}  // namespace raylab
