#include "engine/accel/layout_bvh2q.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "engine/core/error.h"

namespace raylab {
namespace {

constexpr double kCells = 65535.0;
constexpr double kSpareCells =
    2.0;  // at either end: one for rounding outwards by a step more, one for rounding the origin

/// The step is at least
/// - 2^-23 of the largest coordinate, so that rounding the origin to a float moves it by half a step at most;
/// - 2^-24 of the largest extent: flat trees keep some thickness, more than a ray moves where |d| is replaced by 1e-20;
/// - 1e-30, as a kernel may flush denormals.
Grid gridFor(const Aabb& bounds) {
    const glm::dvec3 lo(bounds.lo);
    const glm::dvec3 extent = glm::dvec3(bounds.hi) - lo;
    const glm::dvec3 largestCoordinate = glm::max(glm::abs(lo), glm::abs(glm::dvec3(bounds.hi)));
    const double largestExtent = std::max({extent.x, extent.y, extent.z});
    glm::dvec3 step = extent / (kCells - 3.0 * kSpareCells - 1.0);
    step = glm::max(step, largestCoordinate * 0x1p-23);
    step = glm::max(step, glm::dvec3(std::max(largestExtent * 0x1p-24, 1e-30)));
    Grid grid;
    grid.step = glm::vec3(step);
    grid.origin = glm::vec3(lo - kSpareCells * glm::dvec3(grid.step));
    return grid;
}

uint32_t quantise(const Grid& grid, int axis, float lo, float hi) {
    const auto origin = static_cast<double>(grid.origin[axis]);
    const auto step = static_cast<double>(grid.step[axis]);
    const double qLo = std::floor((static_cast<double>(lo) - origin) / step) - 1.0;
    const double qHi = std::ceil((static_cast<double>(hi) - origin) / step) + 1.0;
    assert(qLo >= 0.0 && qHi <= kCells);
    return static_cast<uint32_t>(qLo) | (static_cast<uint32_t>(qHi) << 16);
}

void quantise(const Grid& grid, const Aabb& box, uint32_t (&words)[3]) {
    for (int axis = 0; axis < 3; ++axis) words[axis] = quantise(grid, axis, box.lo[axis], box.hi[axis]);
}

/// A tree that is one leaf: its halves, or its only primitive twice.
NodeBvh2q flattenLeafRoot(const BvhNode& leaf, const Grid& grid, uint32_t primitiveBase) {
    const uint32_t first = primitiveBase + leaf.first;
    const uint32_t half = (leaf.count + 1) / 2;
    NodeBvh2q node;
    quantise(grid, leaf.bounds, node.box0);
    quantise(grid, leaf.bounds, node.box1);
    node.child0 = leafReference(first, half);
    node.child1 = leaf.count == 1 ? node.child0 : leafReference(first + half, leaf.count - half);
    return node;
}

/// How many inner nodes come before each node.
std::vector<uint32_t> innerNodesBefore(const std::vector<BvhNode>& nodes, uint32_t& total) {
    std::vector<uint32_t> before(nodes.size());
    total = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
        before[i] = total;
        total += nodes[i].isLeaf() ? 0u : 1u;
    }
    return before;
}

void check(const Bvh& bvh, uint32_t nodeBase, uint32_t primitiveBase) {
    if (static_cast<uint64_t>(nodeBase) + bvh.nodes.size() > kLeafBit)
        throw Error("BVH: node references need more than 31 bits; use fewer or smaller meshes");
    if (static_cast<uint64_t>(primitiveBase) + bvh.order.size() > kMaxBvhPrimitives)
        throw Error("BVH: more than " + std::to_string(kMaxBvhPrimitives) +
                    " primitives in all trees together; use fewer or smaller meshes");
}

}  // namespace

TreeBvh2q flattenBvh2q(const Bvh& bvh, uint32_t nodeBase, uint32_t primitiveBase) {
    check(bvh, nodeBase, primitiveBase);
    TreeBvh2q tree;
    if (bvh.nodes.empty()) return tree;
    tree.grid = gridFor(bvh.nodes[0].bounds);
    tree.depth = std::max(bvh.depth, 1u);
    if (bvh.nodes[0].isLeaf()) {
        tree.nodes = {flattenLeafRoot(bvh.nodes[0], tree.grid, primitiveBase)};
        return tree;
    }
    uint32_t innerNodes = 0;
    const std::vector<uint32_t> index = innerNodesBefore(bvh.nodes, innerNodes);
    tree.nodes.resize(innerNodes);
    const auto reference = [&](uint32_t child) {
        const BvhNode& node = bvh.nodes[child];
        return node.isLeaf() ? leafReference(primitiveBase + node.first, node.count) : nodeBase + index[child];
    };
    tbb::parallel_for(size_t{0}, bvh.nodes.size(), [&](size_t i) {
        const BvhNode& source = bvh.nodes[i];
        if (source.isLeaf()) return;
        NodeBvh2q& node = tree.nodes[index[i]];
        quantise(tree.grid, bvh.nodes[source.left].bounds, node.box0);
        quantise(tree.grid, bvh.nodes[source.left + 1].bounds, node.box1);
        node.child0 = reference(source.left);
        node.child1 = reference(source.left + 1);
    });
    return tree;
}

}  // namespace raylab
