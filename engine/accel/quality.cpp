#include "engine/accel/quality.h"

#include <algorithm>

namespace raylab {

double halfAreaDouble(const Aabb& box) {
    const glm::dvec3 e = glm::dvec3(box.hi) - glm::dvec3(box.lo);
    return e.x * (e.y + e.z) + e.y * e.z;
}

double sharedHalfArea(const Aabb& a, const Aabb& b) {
    for (int axis = 0; axis < 3; ++axis)
        if ((a.hi[axis] == b.lo[axis]) != (b.hi[axis] == a.lo[axis])) return 0.0;
    const Aabb shared{glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
    return shared.empty() ? 0.0 : halfAreaDouble(shared);
}

namespace {

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
    double innerArea = 0.0;
    double sharedArea = 0.0;
    for (size_t i = 0; i < bvh.nodes.size(); ++i) {
        const BvhNode& node = bvh.nodes[i];
        const double nodeCost = node.isLeaf() ? static_cast<double>(config.intersectionCost) * node.count
                                              : static_cast<double>(config.traversalCost);
        cost += nodeCost * halfAreaDouble(node.bounds);
        if (!node.isLeaf()) {
            innerArea += halfAreaDouble(node.bounds);
            sharedArea += sharedHalfArea(bvh.nodes[node.left].bounds, bvh.nodes[node.left + 1].bounds);
            continue;
        }
        ++quality.leaves;
        countAt(quality.leafSizeHistogram, node.count);
        countAt(quality.depthHistogram, depths[i]);
    }
    const double rootArea = halfAreaDouble(bvh.nodes[0].bounds);
    quality.sah = rootArea > 0.0 ? cost / rootArea : 0.0;
    quality.siblingOverlap = innerArea > 0.0 ? sharedArea / innerArea : 0.0;
    quality.depth = *std::max_element(depths.begin(), depths.end());
    quality.meanLeafSize = static_cast<double>(bvh.order.size()) / static_cast<double>(quality.leaves);
    return quality;
}

}  // namespace raylab
