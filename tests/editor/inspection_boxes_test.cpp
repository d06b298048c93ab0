#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/measure/box_choice.h"
#include "engine/measure/build_figures.h"
#include "tests/unit/inspection_support.h"

namespace raylab {
namespace {

using namespace inspection_test;

const glm::vec3 kEye{2.4f, 1.9f, 2.8f}, kTarget{0.3f, 0.4f, 0.2f};
constexpr float kSlope = 0.35f, kAspect = 1.6f;

/// The camera's axes as glm has them, with the two slopes.
BoxView viewFrom(const glm::vec3& eye, const glm::vec3& target) {
    const glm::mat4 look = glm::transpose(glm::lookAt(eye, target, glm::vec3(0, 1, 0)));
    return {look[0] / (kSlope * kAspect), look[1] / kSlope, -look[2]};
}

/// By glm's perspective, in double precision.
double areaByPerspective(const TreeInspection& trees, const TreeNode& at, const glm::dvec3& eye,
                         const glm::dvec3& target) {
    const glm::dmat4 projection =
        glm::perspective(2.0 * std::atan(static_cast<double>(kSlope)), static_cast<double>(kAspect), 0.01, 100.0) *
        glm::lookAt(eye, target, glm::dvec3(0, 1, 0));
    const Aabb& box = trees.node(at).bounds;
    glm::dvec2 lo(1e30), hi(-1e30);
    int before = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 corner((i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                                (i & 4) != 0 ? box.hi.z : box.lo.z, 1.0);
        const glm::dvec4 clip = projection * (glm::dmat4(trees.toWorld(at)) * corner);
        if (clip.w <= 0.0) continue;
        ++before;
        lo = glm::min(lo, glm::dvec2(clip) / clip.w);
        hi = glm::max(hi, glm::dvec2(clip) / clip.w);
    }
    if (before == 0 || before < 8) return before == 0 ? 0.0 : 1.0;
    const glm::dvec2 size = glm::min(hi, glm::dvec2(1.0)) - glm::max(lo, glm::dvec2(-1.0));
    return size.x <= 0.0 || size.y <= 0.0 ? 0.0 : size.x * size.y / 4.0;
}

TEST(BoxChoice, MeasuresWhatAPerspectiveMatrixShows) {
    const TreeInspection trees = inspectTrees(instanceScene(), kMeshTrees);
    for (const TreeNode& at : allNodes(trees))
        EXPECT_NEAR(areaInView(trees, at, viewFrom(kEye, kTarget)), areaByPerspective(trees, at, kEye, kTarget), 2e-5);
}

TEST(BoxChoice, FindsTheLargestInViewOfAll) {
    const TreeInspection trees = inspectTrees(soupScene(2000), {});
    for (const glm::vec3& eye : {kEye, glm::vec3(0.5f, 0.5f, 0.4f)})  // from without, and from within the root's box
        for (const BoxFilter& filter : {BoxFilter{0, 60, false}, BoxFilter{3, 7, false}, BoxFilter{0, 60, true}}) {
            std::vector<double> expected;
            for (const TreeNode& at : allNodes(trees)) {
                const uint32_t depth = trees.depth(at);
                const double area = areaByPerspective(trees, at, eye, kTarget);
                if (depth >= filter.depthMin && depth <= filter.depthMax && (!filter.leavesOnly || trees.isLeaf(at)) &&
                    area > 1e-9)
                    expected.push_back(area);
            }
            std::ranges::sort(expected, std::greater<>());
            const std::vector<TreeNode> found = largestInView(trees, filter, viewFrom(eye, kTarget), 60);
            ASSERT_EQ(found.size(), std::min<size_t>(expected.size(), 60));
            for (size_t i = 0; i < found.size(); ++i)
                EXPECT_NEAR(areaByPerspective(trees, found[i], eye, kTarget), expected[i], 3e-5) << i;
        }
}

TEST(BoxChoice, ShowsNothingBehindTheCameraAndEndsWhenTold) {
    const TreeInspection trees = inspectTrees(soupScene(500), {});
    const BoxView away = viewFrom({0.5f, 0.5f, 5.0f}, {0.5f, 0.5f, 9.0f});
    EXPECT_TRUE(largestInView(trees, {0, 60, false}, away, 100).empty());
    const std::atomic<bool> cancel{true};
    EXPECT_THROW(largestInView(trees, {0, 60, false}, viewFrom(kEye, kTarget), 100, &cancel), Cancelled);
}

TEST(TreeInspection, PathsBeginAtTheRootAndEndAtTheNode) {
    const TreeInspection trees = inspectTrees(instanceScene(), kMeshTrees);
    for (const TreeNode& at : allNodes(trees)) {
        const std::vector<TreeNode> path = pathTo(trees, at);
        ASSERT_EQ(path.size(), trees.depth(at) + 1u);
        EXPECT_EQ(path.front(), trees.root());
        EXPECT_EQ(path.back(), at);
        for (size_t i = 1; i < path.size(); ++i) {
            const std::vector<TreeNode> below = trees.children(path[i - 1]);
            EXPECT_NE(std::ranges::find(below, path[i]), below.end());
        }
    }
}

TEST(BuildFigures, AddUpToWhatTheRendererKeeps) {
    for (const Scene& scene : {soupScene(3000), instanceScene()})
        for (const char* layout : {"bvh2", "bvh4q"}) {
            TraceConfig config = kMeshTrees;
            config.layout = layout;
            const TraceData data = buildTraceData(scene, config);
            const BuildFigures figures = measureBuild(inspectTrees(scene, config), config);
            EXPECT_EQ(figures.nodeBytes, data.nodes.size() * sizeof(glm::uvec4)) << layout;
            EXPECT_EQ(figures.instanceBytes, data.instances.size() * sizeof(shared::TraceInstance));
            EXPECT_GT(figures.triangleBytes, 0u);
        }
}

/// Two triangles side by side make a root over two leaves: a ray along the first meets one inner node, two boxes and
/// one triangle, and one that passes by meets the root alone.
TEST(BuildFigures, CostOfRaysFollowsTheClosedForm) {
    Scene scene;
    accel_test::TestMesh mesh;
    mesh.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    mesh.add({10, 0, 0}, {11, 0, 0}, {10, 1, 0});
    support::addMesh(scene, support::meshOf(mesh, support::addMaterial(scene, support::lambert(0.5f))));
    TraceConfig config;
    config.bvh.maxLeafSize = 1;
    config.bvh.traversalCost = 2.0f;
    config.bvh.intersectionCost = 3.0f;
    const TreeInspection trees = inspectTrees(scene, config);
    const std::array<WalkRay, 2> rays = {WalkRay{{0.2f, 0.2f, 5.0f}, {0, 0, -1}},
                                         WalkRay{{5.0f, 0.2f, 5.0f}, {0, 0, -1}}};
    const WalkCost cost = measureWalks(trees, rays);
    EXPECT_DOUBLE_EQ(cost.steps, 1.5);
    EXPECT_DOUBLE_EQ(cost.boxes, 2.0);
    EXPECT_DOUBLE_EQ(cost.primitives, 0.5);
    EXPECT_DOUBLE_EQ(cost.cost, 2.0 + 0.5 * 3.0);
    EXPECT_EQ(measureWalks(trees, {}).rays, 0u);
}

TEST(BuildFigures, DifferencesAreOfTheSecondToTheFirst) {
    const TreeInspection a = inspectTrees(soupScene(500), {});
    TraceConfig config;
    config.bvh.maxLeafSize = 1;
    const TreeInspection b = inspectTrees(soupScene(500), config);
    const auto rows = compareBuilds({&a, nullptr, 2.0, {}}, {&b, nullptr, 1.5, {}});
    const auto row = [&](const char* name) { return *std::ranges::find(rows, name, &FigurePair::name); };
    EXPECT_DOUBLE_EQ(row("EPO").difference().value(), -0.25);
    EXPECT_DOUBLE_EQ(row("SAH").difference().value(), b.sah / a.sah - 1.0);
    EXPECT_FALSE(row("memory").difference().has_value());
}

}  // namespace
}  // namespace raylab
