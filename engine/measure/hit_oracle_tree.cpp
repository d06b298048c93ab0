#include "engine/measure/hit_oracle_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>

namespace raylab::oracle {
namespace {

constexpr size_t kLeafSize = 4;
constexpr size_t kParallelSize = 4096;  ///< below, a task costs more than it brings
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

PaddedTree::PaddedTree(const std::vector<Box>& boxes) {
    for (uint32_t i = 0; i < boxes.size(); ++i)
        if (!boxes[i].isEmpty()) order_.push_back(i);
    size_t leaves = 1;
    while (leaves * kLeafSize < order_.size()) leaves *= 2;
    firstLeaf_ = leaves - 1;
    nodes_.resize(2 * leaves - 1);
    build(boxes, 0, 0, order_.size());
}

void PaddedTree::build(const std::vector<Box>& boxes, size_t node, size_t first, size_t last) {
    Box centroids;
    for (size_t i = first; i < last; ++i) {
        const Box& box = boxes[order_[i]];
        nodes_[node].include(box);
        centroids.include(box.lo + box.hi);
    }
    if (node >= firstLeaf_) return;
    const glm::dvec3 extent = centroids.hi - centroids.lo;
    const int axis = extent.x > extent.y && extent.x > extent.z ? 0 : extent.y > extent.z ? 1 : 2;
    const size_t middle = first + (last - first) / 2;
    const auto at = [this](size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](uint32_t a, uint32_t b) {
        return boxes[a].lo[axis] + boxes[a].hi[axis] < boxes[b].lo[axis] + boxes[b].hi[axis];
    });
    const auto left = [&] { build(boxes, 2 * node + 1, first, middle); };
    const auto right = [&] { build(boxes, 2 * node + 2, middle, last); };
    if (last - first >= kParallelSize) {
        tbb::parallel_invoke(left, right);
    } else {
        left();
        right();
    }
}

double PaddedTree::entryOf(const PaddedRay& ray, const Box& box) {
    if (box.isEmpty()) return kInfinity;
    const glm::dvec3 lo = box.lo - ray.origin, hi = box.hi - ray.origin;
    const glm::dvec3 far = glm::max(glm::abs(lo), glm::abs(hi));
    const double pad = ray.padPerDistance * std::max({far.x, far.y, far.z}) + ray.padAlways;
    double near = ray.tMin, end = kInfinity;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = lo[axis] - pad, b = hi[axis] + pad, d = ray.direction[axis];
        if (d == 0.0) {
            if (a > 0.0 || b < 0.0) return kInfinity;
            continue;
        }
        near = std::max(near, std::min(a / d, b / d));
        end = std::min(end, std::max(a / d, b / d));
    }
    return near <= end ? near : kInfinity;
}

}  // namespace raylab::oracle
