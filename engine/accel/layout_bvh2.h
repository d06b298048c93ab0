#pragma once

#include "engine/accel/layout.h"

namespace raylab {

/// Two children and their boxes as floats, in 64 bytes: the layout of Aila and Laine, "Understanding the Efficiency of
/// Ray Traversal on GPUs", HPG 2009. References as leafReference() says; both children are always there.
struct NodeBvh2 {
    glm::vec3 lo0;
    uint32_t child0;
    glm::vec3 hi0;
    uint32_t child1;
    glm::vec3 lo1;
    uint32_t spare0;
    glm::vec3 hi1;
    uint32_t spare1;
};
static_assert(sizeof(NodeBvh2) == 64);

/// Boxes are those of the tree, widened by paddedBox(). See flatten() and flattenBinary().
FlatTree flattenTreeBvh2(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase);

}  // namespace raylab
