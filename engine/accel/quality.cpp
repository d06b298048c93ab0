#include "engine/accel/quality.h"

#include <algorithm>

namespace raylab {
namespace {

double halfArea(const Aabb& box) {
    const glm::dvec3 e = glm::dvec3(box.hi) - glm::dvec3(box.lo);
    return e.x * (e.y + e.z) + e.y * e.z;
}

void countAt(std::vector<uint32_t>& histogram, size_t index) {
    if (histogram.size() <= index) histogram.resize(index + 1, 0);
    ++histogram[index];
}

/// Parents come before their children, so one pass from the front reaches every depth.
std::vector<uint8_t> depthsOf(const Bvh& bvh) {
    std::vector<uint8_t> depths(bvh.nodes.size(), 0);
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        const BvhNode& node = bvh.nodes[i];
        if (!node.isLeaf()) depths[node.left] = depths[node.left + 1] = static_cast<uint8_t>(depths[i] + 1);
    }
    return depths;
}

}  // namespace

BvhQuality measureQuality(const Bvh& bvh, const BvhConfig& config) {
    BvhQuality quality;
    quality.nodes = bvh.nodes.size();
    if (bvh.nodes.empty()) return quality;
    const std::vector<uint8_t> depths = depthsOf(bvh);
    double cost = 0.0;
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        const BvhNode& node = bvh.nodes[i];
        const double nodeCost = node.isLeaf() ? static_cast<double>(config.intersectionCost) * node.count
                                              : static_cast<double>(config.traversalCost);
        cost += nodeCost * halfArea(node.bounds);
        if (!node.isLeaf()) continue;
        ++quality.leaves;
        countAt(quality.leafSizeHistogram, node.count);
        countAt(quality.depthHistogram, depths[i]);
    }
    const double rootArea = halfArea(bvh.nodes[0].bounds);
    quality.sah = rootArea > 0.0 ? cost / rootArea : 0.0;
    quality.depth = *std::max_element(depths.begin(), depths.end());
    quality.meanLeafSize = static_cast<double>(bvh.order.size()) / static_cast<double>(quality.leaves);
    return quality;
}

}  // namespace raylab
