#include "engine/accel/layout_bvh2q.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/accel/layout_binary.h"

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

/// Makes the nodes in `out`, as NodeBvh2q or in words.
template <class Word>
Grid flattenInto(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase, std::vector<Word>& out) {
    const Grid grid = gridFor(bvh.nodes[0].bounds);
    const auto makeNode = [&](const Aabb& box0, const Aabb& box1, uint32_t child0, uint32_t child1) {
        NodeBvh2q node;
        quantise(grid, box0, node.box0);
        quantise(grid, box1, node.box1);
        node.child0 = child0;
        node.child1 = child1;
        return node;
    };
    flattenBinary<NodeBvh2q>(bvh, nodeBase, slotBase, makeNode, out);
    return grid;
}

}  // namespace

TreeBvh2q flattenBvh2q(const Bvh& bvh, uint32_t nodeBase, uint32_t primitiveBase) {
    TreeBvh2q tree;
    if (bvh.nodes.empty()) return tree;
    tree.grid = flattenInto(bvh, nodeBase, primitiveBase, tree.nodes);
    tree.depth = std::max(bvh.depth, 1u);
    return tree;
}

FlatTree flattenTreeBvh2q(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase) {
    FlatTree tree;
    if (bvh.nodes.empty()) return tree;
    tree.grid = flattenInto(bvh, nodeBase, slotBase, tree.words);
    finishBinary<NodeBvh2q>(bvh, nodeBase, tree);
    return tree;
}

}  // namespace raylab
