#include "engine/accel/inspect.h"

#include <algorithm>

#include "engine/accel/quality.h"

namespace raylab {
namespace {

double costOf(const BvhNode& node, const BvhConfig& config) {
    return node.isLeaf() ? static_cast<double>(config.intersectionCost) * node.count
                         : static_cast<double>(config.traversalCost);
}

/// Parents come before their children: from the front.
void linkParents(const Bvh& bvh, std::vector<NodeFacts>& facts) {
    for (uint32_t i = 0; i < bvh.nodes.size(); ++i) {
        const BvhNode& node = bvh.nodes[i];
        if (node.isLeaf()) continue;
        for (const uint32_t child : {node.left, node.left + 1}) {
            facts[child].parent = i;
            facts[child].depth = facts[i].depth + 1;
        }
    }
}

/// From the back: the slots below the left child come first.
void countPrimitives(const Bvh& bvh, std::vector<NodeFacts>& facts) {
    for (size_t i = bvh.nodes.size(); i-- > 0;) {
        const BvhNode& node = bvh.nodes[i];
        facts[i].firstSlot = node.isLeaf() ? node.first : facts[node.left].firstSlot;
        facts[i].primitives =
            node.isLeaf() ? node.count : facts[node.left].primitives + facts[node.left + 1].primitives;
    }
}

}  // namespace

std::vector<NodeFacts> inspectNodes(const Bvh& bvh, const BvhConfig& config) {
    std::vector<NodeFacts> facts(bvh.nodes.size());
    if (facts.empty()) return facts;
    linkParents(bvh, facts);
    countPrimitives(bvh, facts);
    double total = 0.0;
    for (size_t i = 0; i < facts.size(); ++i) {
        const BvhNode& node = bvh.nodes[i];
        facts[i].sahShare = costOf(node, config) * halfAreaDouble(node.bounds);
        total += facts[i].sahShare;
        if (node.isLeaf()) continue;
        const double shared = sharedHalfArea(bvh.nodes[node.left].bounds, bvh.nodes[node.left + 1].bounds);
        for (const uint32_t child : {node.left, node.left + 1}) {
            const double area = halfAreaDouble(bvh.nodes[child].bounds);
            facts[child].siblingOverlap = area > 0.0 ? std::min(shared / area, 1.0) : 0.0;
        }
    }
    for (NodeFacts& fact : facts) fact.sahShare = total > 0.0 ? fact.sahShare / total : 0.0;
    return facts;
}

}  // namespace raylab
