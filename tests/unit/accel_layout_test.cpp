#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/accel/build_binned.h"
#include "engine/accel/layout_bvh2q.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/core/error.h"
#include "tests/unit/accel_support.h"

namespace raylab {
namespace {

using accel_test::Random;

/// Positions of a box's planes in real numbers, which double is to within 1e-16.
glm::dvec3 decode(const Grid& grid, const uint32_t (&words)[3], int shift) {
    const glm::dvec3 q((words[0] >> shift) & 0xffffu, (words[1] >> shift) & 0xffffu, (words[2] >> shift) & 0xffffu);
    return glm::dvec3(grid.origin) + q * glm::dvec3(grid.step);
}

/// The box must lie at least a whole step inside, and not more than about three.
void checkBox(const Grid& grid, const uint32_t (&words)[3], const Aabb& box) {
    const glm::dvec3 step(grid.step);
    const glm::dvec3 below = (glm::dvec3(box.lo) - decode(grid, words, 0)) / step;
    const glm::dvec3 above = (decode(grid, words, 16) - glm::dvec3(box.hi)) / step;
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(below[axis], 1.0 - 1e-9);
        EXPECT_GE(above[axis], 1.0 - 1e-9);
        EXPECT_LE(below[axis], 2.0 + 1e-9);
        EXPECT_LE(above[axis], 2.0 + 1e-9);
    }
}

/// Walks both trees side by side. Returns the number of references that a depth-first traversal may have to keep.
uint32_t checkNode(const Bvh& bvh, const TreeBvh2q& tree, uint32_t base, uint32_t primitiveBase, uint32_t source,
                   uint32_t reference) {
    const BvhNode& node = bvh.nodes[source];
    if (node.isLeaf()) {
        EXPECT_TRUE(isLeafReference(reference));
        EXPECT_EQ(leafFirst(reference), node.first + primitiveBase);
        EXPECT_EQ(leafCount(reference), node.count);
        return 0;
    }
    EXPECT_FALSE(isLeafReference(reference));
    const NodeBvh2q& flat = tree.nodes.at(reference - base);
    checkBox(tree.grid, flat.box0, bvh.nodes[node.left].bounds);
    checkBox(tree.grid, flat.box1, bvh.nodes[node.left + 1].bounds);
    return 1 + std::max(checkNode(bvh, tree, base, primitiveBase, node.left, flat.child0),
                        checkNode(bvh, tree, base, primitiveBase, node.left + 1, flat.child1));
}

void checkFlattened(const Bvh& bvh, uint32_t nodeBase = 0, uint32_t primitiveBase = 0) {
    const TreeBvh2q tree = flattenBvh2q(bvh, nodeBase, primitiveBase);
    EXPECT_TRUE(glm::all(glm::greaterThan(tree.grid.step, glm::vec3(0.0f))));
    EXPECT_EQ(tree.nodes.size(), (bvh.nodes.size() - 1) / 2);
    EXPECT_LE(checkNode(bvh, tree, nodeBase, primitiveBase, 0, nodeBase), tree.depth);
}

TEST(AccelLayout, ReferencesRoundTrip) {
    for (const uint32_t first : {0u, 1u, 77777u, 0x07ffffffu})
        for (const uint32_t count : {1u, 2u, 16u}) {
            const uint32_t reference = leafReference(first, count);
            EXPECT_TRUE(isLeafReference(reference));
            EXPECT_EQ(leafFirst(reference), first);
            EXPECT_EQ(leafCount(reference), count);
        }
    EXPECT_FALSE(isLeafReference(0x7fffffffu));
}

TEST(AccelLayout, BoxesContainTheFloatBoxesAtAnyScaleAndOffset) {
    Random random(31);
    for (int i = 0; i < 200; ++i) {
        const float scale = std::pow(10.0f, random.uniform(-6.0f, 6.0f));
        const float offset = i % 4 == 0 ? 0.0f : std::pow(10.0f, random.uniform(-6.0f, 6.0f));
        const glm::vec3 shift = random.inCube(-offset, offset);
        std::vector<Aabb> bounds;
        for (int box = 0; box < 100; ++box) {
            const glm::vec3 lo = shift + random.inCube(-scale, scale);
            bounds.push_back({lo, lo + random.inCube(0.0f, 0.1f * scale)});
        }
        checkFlattened(buildBinned(bounds));
    }
}

TEST(AccelLayout, FlatAndExtremeTrees) {
    for (const float size : {0.0f, 1e-38f, 1e-30f, 1.0f, 1e15f})
        for (const float offset : {0.0f, 1.0f, -1e6f, 9e14f}) {
            std::vector<Aabb> bounds;
            for (int i = 0; i < 20; ++i) {
                glm::vec3 p(offset, 0.0f, -offset);
                p[i % 3] += size * static_cast<float>(i) / 20.0f;
                bounds.push_back({glm::max(p, -kLargestCoordinate), glm::min(p, kLargestCoordinate)});
            }
            checkFlattened(buildBinned(bounds));
        }
}

TEST(AccelLayout, BasesAreAdded) {
    const accel_test::TestMesh mesh = accel_test::randomSoup(3000, 0.05f, 32);
    checkFlattened(buildBinned(triangleBounds(mesh.positions, mesh.triangles)), 12345, 678910);
}

TEST(AccelLayout, ChildrenOfANodeAreNeighbours) {
    const accel_test::TestMesh mesh = accel_test::randomSoup(3000, 0.05f, 33);
    for (const NodeBvh2q& node : flattenBvh2q(buildBinned(triangleBounds(mesh.positions, mesh.triangles)), 0, 0).nodes)
        if (!isLeafReference(node.child0) && !isLeafReference(node.child1)) {
            EXPECT_EQ(node.child1, node.child0 + 1);
        }
}

TEST(AccelLayout, TreesWithoutInnerNodes) {
    EXPECT_TRUE(flattenBvh2q(Bvh(), 0, 0).nodes.empty());
    BvhConfig config;
    config.maxLeafSize = 16;
    for (const uint32_t count : {1u, 2u, 5u, 16u}) {
        const Aabb box{glm::vec3(1.0f), glm::vec3(2.0f)};
        const Bvh bvh = buildBinned(std::vector<Aabb>(count, box), config);
        ASSERT_EQ(bvh.nodes.size(), 1u) << "one leaf is cheaper than two boxes of the same size";
        const TreeBvh2q tree = flattenBvh2q(bvh, 7, 100);
        ASSERT_EQ(tree.nodes.size(), 1u);
        const NodeBvh2q& node = tree.nodes[0];
        checkBox(tree.grid, node.box0, box);
        checkBox(tree.grid, node.box1, box);
        EXPECT_EQ(leafFirst(node.child0), 100u);
        if (count == 1) {
            EXPECT_EQ(node.child0, node.child1);
        } else {
            EXPECT_EQ(leafFirst(node.child1), 100 + leafCount(node.child0));
            EXPECT_EQ(leafCount(node.child0) + leafCount(node.child1), count);
        }
    }
}

TEST(AccelLayout, RefusesWhatReferencesCannotHold) {
    const Bvh bvh = buildBinned(std::vector<Aabb>(100, Aabb{glm::vec3(0.0f), glm::vec3(1.0f)}));
    EXPECT_THROW(flattenBvh2q(bvh, 0x7ffffff0u, 0), Error);
    EXPECT_THROW(flattenBvh2q(bvh, 0, (1u << 27) - 50u), Error);
    EXPECT_NO_THROW(flattenBvh2q(bvh, 0, (1u << 27) - 100u));
}

}  // namespace
}  // namespace raylab
