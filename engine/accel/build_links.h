#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/accel/bvh.h"

namespace raylab {

/// What a LinkedTree is made of and does not divide: a primitive, or a leaf.
struct LinkedUnit {
    Aabb bounds;
    uint32_t first = 0;  ///< its primitives in LinkedTree::ids
    uint32_t count = 1;
};

/// What matters of a subtree to the node above it.
struct LinkedSummary {
    float cost = 0.0f;        ///< SAH cost, times the root's area
    uint32_t primitives = 0;  ///< below, or in a leaf
    uint32_t below = 0;       ///< nodes that the Bvh will have below; 0: a leaf
    uint32_t height = 0;      ///< edges to the deepest leaf
};

/// A child is a unit's index or, from the number of units on, an inner node's.
struct LinkedNode {
    Aabb bounds;
    uint32_t left;
    uint32_t right;
    LinkedSummary summary;
    bool forcedLeaf;  ///< of the balanced parts that keep the depth
};

/// A binary tree that grows from its leaves, on the way to a Bvh. Children come before their parents, the root is last;
/// each unit is below it exactly once. Subtrees of up to `maxLeafSize` primitives become leaves where that is not
/// dearer.
struct LinkedTree {
    std::unique_ptr<LinkedUnit[]> units;
    std::unique_ptr<LinkedNode[]> inner;  ///< one less than units
    size_t unitCount = 0;                 ///< at least one
    std::span<const uint32_t> ids;
    BvhConfig config;
    uint32_t maxLeafSize = 0;  ///< 0: units stay as they are, and do not have to be primitives
    int maxDepth = 0;
    size_t unitsPerLeaf = 1;  ///< how many units a leaf can hold at most, where the depth is short

    LinkedTree(size_t unitCount_, std::span<const uint32_t> ids_, const BvhConfig& config_);

    size_t innerCount() const { return unitCount - 1; }
    bool isUnit(uint32_t child) const { return child < unitCount; }
    const LinkedNode& node(uint32_t child) const { return inner[child - unitCount]; }
    LinkedNode& node(uint32_t child) { return inner[child - unitCount]; }
    const Aabb& boundsOf(uint32_t child) const { return isUnit(child) ? units[child].bounds : node(child).bounds; }
    LinkedSummary summaryOf(uint32_t child) const {
        if (!isUnit(child)) return node(child).summary;
        const LinkedUnit& unit = units[child];
        return {config.intersectionCost * static_cast<float>(unit.count) * unit.bounds.halfArea(), unit.count, 0, 0};
    }
    /// Fills in an inner node from its children.
    void join(size_t index, uint32_t left, uint32_t right);
};

/// In the order that Bvh documents, in parallel. Subtrees that are deeper than maxDepth allows are built again, as
/// halves of their units in order. The tree is used up.
Bvh toBvh(LinkedTree& tree);

}  // namespace raylab
