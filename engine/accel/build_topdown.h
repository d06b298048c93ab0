#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/accel/build_range.h"

namespace raylab {

// A top-down build. What distinguishes the builders is a Splitter:
//   Range: the primitives of one node, with bounds (a Box4), size() and appendIds(ids);
//   optional<Sides<Range>> split(range, levelsLeft) const: the two sides of a node below which that many edges may
//   follow, or nothing where it is to be a leaf, which more than maxLeafSize primitives are never.

/// What one thread builds: nodes[0] the root, in the order that Bvh documents; BvhNode::first counts from `order`.
struct Subtree {
    std::vector<BvhNode> nodes;
    std::vector<uint32_t> order;
    uint32_t depth = 0;  ///< of the deepest leaf, below the root of the whole tree
};

/// A node above the subtrees that one thread builds; without children it holds such a subtree.
struct TopNode {
    Aabb bounds;
    std::unique_ptr<TopNode> left;
    std::unique_ptr<TopNode> right;
    Subtree subtree;
};

/// The tree in one piece; `skipped` is left to the caller.
Bvh joinSubtrees(const TopNode& root);

template <class Splitter>
class TopDownBuild {
public:
    using Range = typename Splitter::Range;

    TopDownBuild(const Splitter& splitter, const BvhConfig& config, BuildMonitor& monitor)
        : splitter_(splitter), maxDepth_(config.maxDepth), monitor_(monitor) {}

    std::unique_ptr<TopNode> build(const Range& range, int level) const {
        monitor_.check();
        auto top = std::make_unique<TopNode>();
        top->bounds = toAabb(range.bounds);
        if (range.size() <= kSubtree) {
            top->subtree = buildSubtree(range, level);
            monitor_.advance(range.size());
            return top;
        }
        const std::optional<Sides<Range>> sides = splitter_.split(range, maxDepth_ - level);
        parallelInvoke([&] { top->left = build(sides->left, level + 1); },
                       [&] { top->right = build(sides->right, level + 1); });
        return top;
    }

private:
    Subtree buildSubtree(const Range& range, int level) const {
        Subtree subtree;
        subtree.nodes.reserve(range.size());
        subtree.order.reserve(range.size());
        subtree.nodes.emplace_back();
        buildBelow(range, 0, level, subtree);
        return subtree;
    }
    /// Fills in nodes[slot] and appends everything below it.
    void buildBelow(const Range& range, size_t slot, int level, Subtree& subtree) const {
        subtree.nodes[slot].bounds = toAabb(range.bounds);
        const std::optional<Sides<Range>> sides = splitter_.split(range, maxDepth_ - level);
        if (!sides) {
            subtree.nodes[slot].first = static_cast<uint32_t>(subtree.order.size());
            subtree.nodes[slot].count = static_cast<uint32_t>(range.size());
            subtree.depth = std::max(subtree.depth, static_cast<uint32_t>(level));
            range.appendIds(subtree.order);
            return;
        }
        const size_t left = subtree.nodes.size();
        subtree.nodes[slot].left = static_cast<uint32_t>(left);
        subtree.nodes.resize(left + 2);
        buildBelow(sides->left, left, level + 1, subtree);
        buildBelow(sides->right, left + 1, level + 1, subtree);
    }

    const Splitter& splitter_;
    int maxDepth_;
    BuildMonitor& monitor_;
};

/// `total`: the references that the leaves hold at most, for the progress. No tree for an empty range.
template <class Splitter>
Bvh buildTopDown(const typename Splitter::Range& range, const Splitter& splitter, const BvhConfig& config,
                 const BuildControl& control, size_t total) {
    if (range.size() == 0) return {};
    BuildMonitor monitor(control, total);
    return joinSubtrees(*TopDownBuild<Splitter>(splitter, config, monitor).build(range, 0));
}

/// The whole build where the Splitter's range is a PrimitiveRange.
template <class Splitter>
Bvh buildOverRefs(std::span<const Aabb> bounds, const Splitter& splitter, const BvhConfig& config,
                  const BuildControl& control) {
    checkConfig(config, bounds.size());
    std::unique_ptr<PrimitiveRef[]> refs;
    PrimitiveRange range = collectRefs(bounds, refs);
    const auto spare = std::make_unique_for_overwrite<PrimitiveRef[]>(range.size());
    range.spare = {spare.get(), range.size()};
    Bvh bvh = buildTopDown(range, splitter, config, control, range.size());
    bvh.skipped = bounds.size() - range.size();
    return bvh;
}

}  // namespace raylab
