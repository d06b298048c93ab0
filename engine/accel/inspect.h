#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/accel/bvh.h"

namespace raylab {

constexpr uint32_t kNoNode = 0xffffffffu;

/// What a person wants to know of a node and its place in the tree.
struct NodeFacts {
    uint32_t parent = kNoNode;
    uint32_t depth = 0;       ///< edges from the root
    uint32_t primitives = 0;  ///< references below it, or in it
    uint32_t firstSlot = 0;   ///< they are order[firstSlot .. firstSlot + primitives)
    /// Its own part of the tree's SAH (measureQuality()), without the nodes below: all of a tree's add up to 1. 0 where
    /// the root has no area.
    double sahShare = 0.0;
    /// The part of its area that the sibling's box covers too: the half area of the intersection of the two boxes over
    /// its own, 0 .. 1. 0 for the root, for boxes that meet in a face only, and for a box without area.
    double siblingOverlap = 0.0;
};

/// One for each of bvh.nodes, in their order. The costs are the config's.
std::vector<NodeFacts> inspectNodes(const Bvh& bvh, const BvhConfig& config = {});

}  // namespace raylab
