#include <gtest/gtest.h>

#include <algorithm>

#include "engine/measure/tree_inspection.h"
#include "tests/unit/inspection_support.h"

namespace raylab {
namespace {

using namespace inspection_test;

/// A root of 2 x 1 x 1 over two boxes of 1.25 x 1 x 1 that share half a unit.
Bvh threeNodes() {
    Bvh bvh;
    bvh.nodes = {{{{0, 0, 0}, {2, 1, 1}}, 1, 0, 0},
                 {{{0, 0, 0}, {1.25f, 1, 1}}, 0, 0, 1},
                 {{{0.75f, 0, 0}, {2, 1, 1}}, 0, 1, 3}};
    bvh.order = {0, 1, 2, 3};
    bvh.depth = 1;
    return bvh;
}

TEST(InspectNodes, FollowTheClosedForm) {
    // Half areas: 5, 3.5 and 3.5; the intersection has 2. Costs 1, 1 and 3.
    const std::vector<NodeFacts> facts = inspectNodes(threeNodes());
    ASSERT_EQ(facts.size(), 3u);
    EXPECT_DOUBLE_EQ(facts[0].sahShare, 5.0 / 19.0);
    EXPECT_DOUBLE_EQ(facts[1].sahShare, 3.5 / 19.0);
    EXPECT_DOUBLE_EQ(facts[2].sahShare, 10.5 / 19.0);
    EXPECT_DOUBLE_EQ(facts[0].siblingOverlap, 0.0);
    EXPECT_DOUBLE_EQ(facts[1].siblingOverlap, 2.0 / 3.5);
    EXPECT_DOUBLE_EQ(facts[2].siblingOverlap, 2.0 / 3.5);
    EXPECT_EQ(facts[0].parent, kNoNode);
    EXPECT_EQ(facts[2].parent, 0u);
    EXPECT_EQ(facts[2].firstSlot, 1u);
    EXPECT_EQ(facts[0].primitives, 4u);
}

/// Counts by going down, the facts having been counted on the way up.
uint32_t countBelow(const Bvh& bvh, const std::vector<NodeFacts>& facts, uint32_t index, uint32_t depth) {
    const BvhNode& node = bvh.nodes[index];
    EXPECT_EQ(facts[index].depth, depth);
    const uint32_t count =
        node.isLeaf() ? node.count
                      : countBelow(bvh, facts, node.left, depth + 1) + countBelow(bvh, facts, node.left + 1, depth + 1);
    EXPECT_EQ(facts[index].primitives, count);
    return count;
}

TEST(InspectNodes, CountWhatIsBelowAndAddUpToTheTree) {
    const TreeInspection trees = inspectTrees(soupScene(3000), {});
    const Bvh& bvh = trees.bvh(0);
    // Triangles of a soup overlap, so that the default builder lists some of them in two leaves.
    EXPECT_GT(bvh.order.size(), 3000u);
    EXPECT_EQ(countBelow(bvh, trees.facts[0], 0, 0), bvh.order.size());
    double sum = 0.0;
    for (const NodeFacts& fact : trees.facts[0]) sum += fact.sahShare;
    EXPECT_NEAR(sum, 1.0, 1e-12);
    const double root = trees.facts[0][0].sahShare;  // the root's own cost is 1 in units of the tree's SAH
    EXPECT_NEAR(1.0 / root, trees.sah, 1e-9 * trees.sah);
}

TEST(TreeInspection, HoldsATreeForEachInstanceBelowTheUpperOne) {
    const Scene scene = instanceScene();
    const TreeInspection trees = inspectTrees(scene, kMeshTrees);
    EXPECT_EQ(trees.placements.size(), scene.instances.size());
    EXPECT_EQ(trees.root().tree, kUpperTree);
    size_t leaves = 0;
    for (const TreeNode& at : allNodes(trees)) {
        leaves += trees.isLeaf(at) ? 1 : 0;
        for (const TreeNode& child : trees.children(at)) {
            EXPECT_EQ(trees.depth(child), trees.depth(at) + 1);
            EXPECT_LE(halfAreaDouble(worldBox(trees, child)), 1.0001 * halfAreaDouble(worldBox(trees, at)));
        }
    }
    EXPECT_GT(leaves, scene.instances.size());
    EXPECT_GE(measureTreeEpo(trees, 0), 0.0);
}

TEST(TreeInspection, CountsTheBoxesOfAFilter) {
    const TreeInspection trees = inspectTrees(instanceScene(), kMeshTrees);
    for (const BoxFilter& filter :
         {BoxFilter{0, 60, false}, BoxFilter{3, 6, false}, BoxFilter{0, 60, true}, BoxFilter{5, 8, true}}) {
        size_t expected = 0;
        for (const TreeNode& at : allNodes(trees)) {
            const uint32_t depth = trees.depth(at);
            const bool isWithin = depth >= filter.depthMin && depth <= filter.depthMax;
            expected += isWithin && (!filter.leavesOnly || trees.isLeaf(at)) ? 1 : 0;
        }
        EXPECT_EQ(countBoxes(trees, filter), expected);
    }
}

TEST(TreeInspection, AnEmptySceneHasNothing) {
    const TreeInspection trees = inspectTrees(Scene{}, {});
    EXPECT_TRUE(trees.empty());
    EXPECT_EQ(countBoxes(trees, {0, 60, false}), 0u);
}

}  // namespace
}  // namespace raylab
