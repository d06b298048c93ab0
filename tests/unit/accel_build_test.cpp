#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <limits>
#include <mutex>
#include <optional>

#include "engine/accel/builders.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/core/error.h"
#include "tests/unit/accel_build_support.h"

namespace raylab {
namespace {

using accel_test::boundsOf;
using accel_test::checkTree;
using accel_test::cube;
using accel_test::expectSameBytes;
using accel_test::inputOf;
using accel_test::Random;
using accel_test::TestMesh;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Every builder by its name.
class AccelBuild : public testing::TestWithParam<std::string> {
protected:
    bool duplicates() const { return accel_test::mayListAgain(GetParam()); }

    Bvh buildAndCheck(const TestMesh& mesh, const BvhConfig& config = {}) const {
        const std::vector<Aabb> bounds = boundsOf(mesh);
        const Bvh bvh = buildBvh(GetParam(), inputOf(mesh, bounds), config);
        checkTree(bvh, bounds, config, !duplicates());
        const double budget = static_cast<double>(config.spatialBudget) * static_cast<double>(bounds.size());
        EXPECT_LE(static_cast<double>(bvh.order.size() + bvh.skipped), static_cast<double>(bounds.size()) + budget);
        return bvh;
    }
    void buildAndCheckBoxes(std::span<const Aabb> bounds, const BvhConfig& config = {}) const {
        checkTree(buildBvh(GetParam(), {bounds, {}, {}}, config), bounds, config);
    }
};

INSTANTIATE_TEST_SUITE_P(, AccelBuild, testing::ValuesIn(builderNames()), [](const auto& test) { return test.param; });

TEST_P(AccelBuild, RandomSoup) { buildAndCheck(accel_test::randomSoup(100000, 0.01f, 1)); }

TEST_P(AccelBuild, Slivers) {
    const TestMesh mesh = accel_test::randomSlivers(5000, 2);
    for (const int leafSize : {1, 4, 16}) {
        BvhConfig config;
        config.maxLeafSize = leafSize;
        accel_test::checkCover(buildAndCheck(mesh, config), mesh, 20, 1e-7, 3);
    }
}

TEST_P(AccelBuild, SmallNumbers) {
    for (size_t count = 0; count <= 40; ++count) buildAndCheck(accel_test::randomSoup(count, 0.3f, 4));
}

/// Boxes with a common centroid: no plane separates them, and splits in space are all that helps.
TEST_P(AccelBuild, MillionEqualCentroids) {
    Random random(6);
    std::vector<Aabb> bounds(duplicates() ? 50000 : 1000000);
    for (Aabb& box : bounds) box = cube(glm::vec3(0.0f), random.uniform(0.001f, 1.0f));
    const std::clock_t start = std::clock();
    const Bvh bvh = buildAndCheck(accel_test::trianglesIn(bounds));
    const double cpuSeconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(cpuSeconds, 60.0) << "3 in a release build; the slack is for sanitizers";
}

TEST_P(AccelBuild, IdenticalBoxes) {
    const std::vector<Aabb> bounds(20000, cube(glm::vec3(1.0f, 2.0f, 3.0f), 0.5f));
    buildAndCheck(accel_test::trianglesIn(bounds));
    buildAndCheckBoxes(bounds);
}

TEST_P(AccelBuild, PointsAndFlatBoxes) {
    Random random(7);
    std::vector<Aabb> bounds(1000);
    for (Aabb& box : bounds) box = cube(random.inCube(-1.0f, 1.0f), 0.0f);
    buildAndCheckBoxes(bounds);
    for (Aabb& box : bounds) box.lo.y = box.hi.y = 0.0f;
    buildAndCheckBoxes(bounds);
    for (Aabb& box : bounds) box.lo.z = box.hi.z = 0.0f;
    buildAndCheckBoxes(bounds);
    for (Aabb& box : bounds) box.lo.x = box.hi.x = 5.0f;
    buildAndCheckBoxes(bounds);
}

/// Each split by area separates the largest few from all the others: without a limit the tree is a list.
TEST_P(AccelBuild, GeometricSizesStayUnderTheDepthLimit) {
    std::vector<Aabb> bounds;
    for (int copy = 0; copy < 50; ++copy)
        for (int i = -60; i < 49; ++i) bounds.push_back(cube(glm::vec3(std::ldexp(1.5f, i)), std::ldexp(0.25f, i)));
    const TestMesh mesh = accel_test::trianglesIn(bounds);
    for (const int maxDepth : {11, 12, 20, 40, 62}) {
        BvhConfig config;
        config.maxDepth = maxDepth;
        buildAndCheck(mesh, config);
        buildAndCheckBoxes(bounds, config);
    }
}

/// Of one size each, so that a small thing in a large world is divided as well as the world.
TEST_P(AccelBuild, ClustersOfManyScales) {
    TestMesh mesh;
    Random random(8);
    for (const float scale : {1.0f, 1e-3f, 1e-6f})
        for (int i = 0; i < 3000; ++i) {
            const glm::vec3 p = glm::vec3(scale > 0.5f ? 0.0f : 1e-2f) + scale * random.inCube(0.0f, 1.0f);
            mesh.add(p, p + 0.01f * scale * random.inCube(0.0f, 1.0f), p + 0.01f * scale * random.inCube(0.0f, 1.0f));
        }
    buildAndCheck(mesh);
}

TEST_P(AccelBuild, SortedStrips) {
    std::vector<Aabb> nested;
    std::vector<Aabb> shifted;
    for (int i = 1; i <= 30000; ++i) {
        const auto x = static_cast<float>(i);
        nested.push_back({glm::vec3(0.0f), glm::vec3(x, 1.0f, 1.0f)});
        shifted.push_back({glm::vec3(x, 0.0f, 0.0f), glm::vec3(x + 1000.0f, 1.0f, 1e-3f)});
    }
    for (const std::vector<Aabb>& bounds : {nested, shifted}) {
        buildAndCheck(accel_test::trianglesIn(bounds));
        buildAndCheckBoxes(bounds);
    }
}

TEST_P(AccelBuild, TightDepthLimit) {
    const TestMesh mesh = accel_test::randomSoup(1000, 0.1f, 9);
    BvhConfig config;
    config.maxDepth = 8;  // 4 * 2^8 = 1024
    buildAndCheck(mesh, config);
    config.maxDepth = 7;
    EXPECT_THROW(buildAndCheck(mesh, config), Error);
}

TEST_P(AccelBuild, LeavesOutWhatHasNoBox) {
    TestMesh mesh = accel_test::randomSoup(1000, 0.1f, 10);
    std::vector<Aabb> bounds = boundsOf(mesh);
    const std::vector<Aabb> bad = {Aabb(),
                                   {glm::vec3(0.0f, kNan, 0.0f), glm::vec3(1.0f)},
                                   {glm::vec3(0.0f), glm::vec3(kNan)},
                                   {glm::vec3(-kInf), glm::vec3(kInf)},
                                   {glm::vec3(0.0f), glm::vec3(1.0f, kInf, 1.0f)},
                                   {glm::vec3(0.0f), glm::vec3(1e30f)}};
    for (size_t i = 0; i < bad.size(); ++i) {
        const auto at = static_cast<std::ptrdiff_t>(i * 100);
        bounds.insert(bounds.begin() + at, bad[i]);
        mesh.triangles.insert(mesh.triangles.begin() + at, glm::uvec3(0xffffffffu));  // not to be looked at
    }
    const Bvh bvh = buildBvh(GetParam(), inputOf(mesh, bounds));
    checkTree(bvh, bounds, {}, !duplicates());
    EXPECT_EQ(bvh.skipped, bad.size());
    const Bvh nothing = buildBvh(GetParam(), {bad, {}, {}});
    EXPECT_TRUE(nothing.nodes.empty());
    EXPECT_TRUE(nothing.order.empty());
    EXPECT_EQ(nothing.skipped, bad.size());
}

TEST_P(AccelBuild, SameBytesForAnyNumberOfThreads) {
    TestMesh zeros = accel_test::randomSoup(20000, 0.01f, 12);
    for (size_t i = 0; i < zeros.positions.size(); ++i)
        zeros.positions[i].x = std::copysign(0.0f, i % 3 == 0 ? -1.0f : 1.0f);  // min(-0, +0) is either
    const std::vector<Aabb> same(20000, cube(glm::vec3(1.0f), 1.0f));
    for (const TestMesh& mesh : {accel_test::randomSoup(80000, 0.01f, 11), zeros, accel_test::trianglesIn(same)}) {
        const std::vector<Aabb> bounds = boundsOf(mesh);
        std::optional<Bvh> reference;
        for (const size_t threads : {1u, 2u, 4u}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            const Bvh bvh = buildBvh(GetParam(), inputOf(mesh, bounds));
            if (!reference) reference = bvh;
            expectSameBytes(bvh, *reference);
        }
    }
}

TEST_P(AccelBuild, ReportsProgress) {
    const TestMesh mesh = accel_test::randomSoup(30000, 0.01f, 13);
    const std::vector<Aabb> bounds = boundsOf(mesh);
    std::mutex mutex;
    std::vector<float> parts;
    BuildControl control;
    control.progress = [&](float part) {
        const std::lock_guard lock(mutex);
        parts.push_back(part);
    };
    buildBvh(GetParam(), inputOf(mesh, bounds), {}, control);
    EXPECT_GT(parts.size(), 3u);
    EXPECT_LT(parts.size(), 70u);
    EXPECT_EQ(parts.back(), 1.0f);
    EXPECT_GT(*std::min_element(parts.begin(), parts.end()), 0.0f);
    EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 1.0f);
}

TEST_P(AccelBuild, CanBeCancelled) {
    const TestMesh mesh = accel_test::randomSoup(70000, 0.005f, 14);
    const std::vector<Aabb> bounds = boundsOf(mesh);
    std::atomic<bool> cancel = true;
    BuildControl control;
    control.cancel = &cancel;
    EXPECT_THROW(buildBvh(GetParam(), inputOf(mesh, bounds), {}, control), Cancelled);
    cancel = false;
    control.progress = [&](float) { cancel = true; };
    EXPECT_THROW(buildBvh(GetParam(), inputOf(mesh, bounds), {}, control), Cancelled);
}

/// As where another mesh of the scene fails meanwhile: the build goes on, or ends by an exception of its own.
TEST_P(AccelBuild, IsNotLeftHalfDoneByTasksAroundIt) {
    const TestMesh mesh = accel_test::randomSoup(70000, 0.005f, 15);
    const std::vector<Aabb> bounds = boundsOf(mesh);
    Bvh bvh;
    tbb::task_group_context context;
    tbb::parallel_for(
        0, 1,
        [&](int) {
            context.cancel_group_execution();
            bvh = buildBvh(GetParam(), inputOf(mesh, bounds));
        },
        context);
    expectSameBytes(bvh, buildBvh(GetParam(), inputOf(mesh, bounds)));
}

TEST_P(AccelBuild, RejectsBadConfigs) {
    const std::vector<Aabb> bounds = {cube(glm::vec3(0.0f), 1.0f)};
    const auto rejects = [&](auto change) {
        BvhConfig config;
        change(config);
        EXPECT_THROW(buildBvh(GetParam(), {bounds, {}, {}}, config), Error);
    };
    rejects([](BvhConfig& c) { c.bins = 1; });
    rejects([](BvhConfig& c) { c.bins = kMaxBvhBins + 1; });
    rejects([](BvhConfig& c) { c.maxLeafSize = 0; });
    rejects([](BvhConfig& c) { c.maxLeafSize = kMaxLeafSize + 1; });
    rejects([](BvhConfig& c) { c.maxDepth = kMaxBvhDepth + 1; });
    rejects([](BvhConfig& c) { c.intersectionCost = 0.0f; });
    rejects([](BvhConfig& c) { c.traversalCost = kNan; });
    rejects([](BvhConfig& c) { c.spatialBudget = -0.1f; });
    rejects([](BvhConfig& c) { c.spatialBudget = kNan; });
    rejects([](BvhConfig& c) { c.spatialOverlap = kNan; });
    rejects([](BvhConfig& c) { c.searchRadius = 0; });
}

TEST(AccelBuilders, AreListedAndFoundByName) {
    ASSERT_EQ(builders().size(), builderNames().size());
    for (const BuilderInfo& info : builders()) EXPECT_FALSE(info.help.empty());
    EXPECT_NO_THROW(buildBvh(kDefaultBuilder, {}));
    try {
        buildBvh("fastest", {});
        FAIL();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("'fastest'"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("binned"), std::string::npos);
    }
}

TEST(AccelTriangleBounds, KeepsWhatCanBeHitOnly) {
    const std::vector<glm::vec3> positions = {{0, 0, 0},          {1, 0, 0},     {0, 1, -2},   {2, 0, 0},
                                              {0.1f, 0.2f, 0.3f}, {kNan, 0, 0},  {0, kInf, 0}, {0, 0, 1e30f},
                                              {1e-20f, 0, 0},     {0, 1e-20f, 0}};
    const std::vector<glm::uvec3> triangles = {{0, 1, 2}, {0, 0, 2}, {0, 1, 10}, {0, 1, 3}, {4, 1, 5},
                                               {6, 1, 2}, {7, 1, 2}, {1, 5, 2},  {0, 8, 9}};
    const std::vector<Aabb> bounds = triangleBounds(positions, triangles);
    ASSERT_EQ(bounds.size(), triangles.size());
    EXPECT_EQ(bounds[0].lo, glm::vec3(0, 0, -2));
    EXPECT_EQ(bounds[0].hi, glm::vec3(1, 1, 0));
    for (size_t i = 1; i < 8; ++i) EXPECT_TRUE(bounds[i].empty()) << i;
    EXPECT_FALSE(bounds[8].empty()) << "small, but not of zero area";
}

}  // namespace
}  // namespace raylab
