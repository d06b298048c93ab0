#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <numeric>
#include <span>

#include "engine/accel/build_binned.h"
#include "engine/accel/quality.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/core/error.h"
#include "tests/unit/accel_support.h"

namespace raylab {
namespace {

using accel_test::Random;
using accel_test::TestMesh;

std::vector<Aabb> boundsOf(const TestMesh& mesh) { return triangleBounds(mesh.positions, mesh.triangles); }

struct Below {
    size_t primitives = 0;
    uint32_t depth = 0;
};

/// Checks the subtree against the primitives themselves: tight boxes, ranges that follow one another, sizes.
Below checkSubtree(const Bvh& bvh, std::span<const Aabb> bounds, const BvhConfig& config, uint32_t index,
                   size_t first) {
    const BvhNode& node = bvh.nodes.at(index);
    Below below;
    Aabb box;
    if (node.isLeaf()) {
        EXPECT_EQ(node.first, first);
        EXPECT_LE(node.count, static_cast<uint32_t>(config.maxLeafSize));
        for (uint32_t slot = node.first; slot < node.first + node.count; ++slot) box.grow(bounds[bvh.order.at(slot)]);
        below.primitives = node.count;
    } else {
        EXPECT_GT(node.left, index);
        const Below left = checkSubtree(bvh, bounds, config, node.left, first);
        const Below right = checkSubtree(bvh, bounds, config, node.left + 1, first + left.primitives);
        for (const uint32_t child : {node.left, node.left + 1}) {
            EXPECT_TRUE(node.bounds.contains(bvh.nodes[child].bounds));
            box.grow(bvh.nodes[child].bounds);
        }
        below.primitives = left.primitives + right.primitives;
        below.depth = 1 + std::max(left.depth, right.depth);
    }
    EXPECT_EQ(node.bounds.lo, box.lo);
    EXPECT_EQ(node.bounds.hi, box.hi);
    return below;
}

void checkTree(const Bvh& bvh, std::span<const Aabb> bounds, const BvhConfig& config) {
    std::vector<uint32_t> usable;
    for (uint32_t i = 0; i < bounds.size(); ++i)
        if (bounds[i].usable()) usable.push_back(i);
    std::vector<uint32_t> ids = bvh.order;
    std::sort(ids.begin(), ids.end());
    ASSERT_EQ(ids, usable);
    EXPECT_EQ(bvh.skipped, bounds.size() - usable.size());
    if (usable.empty()) {
        EXPECT_TRUE(bvh.nodes.empty());
        return;
    }
    const Below all = checkSubtree(bvh, bounds, config, 0, 0);
    EXPECT_EQ(all.primitives, usable.size());
    EXPECT_EQ(all.depth, bvh.depth);
    EXPECT_LE(bvh.depth, static_cast<uint32_t>(config.maxDepth));
}

void buildAndCheck(std::span<const Aabb> bounds, const BvhConfig& config = {}) {
    checkTree(buildBinned(bounds, config), bounds, config);
}

Aabb cube(const glm::vec3& center, float halfSize) { return {center - halfSize, center + halfSize}; }

TEST(AccelBuild, RandomSoup) { buildAndCheck(boundsOf(accel_test::randomSoup(200000, 0.01f, 1))); }

TEST(AccelBuild, Slivers) {
    for (const int leafSize : {1, 4, 16}) {
        BvhConfig config;
        config.maxLeafSize = leafSize;
        buildAndCheck(boundsOf(accel_test::randomSlivers(20000, 2)), config);
    }
}

TEST(AccelBuild, Dragon) {
    const std::optional<TestMesh> dragon = accel_test::readDragon();
    if (!dragon) GTEST_SKIP() << accel_test::kNoDragon;
    const std::vector<Aabb> bounds = boundsOf(*dragon);
    const auto start = std::chrono::steady_clock::now();
    const Bvh bvh = buildBinned(bounds);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    checkTree(bvh, bounds, {});
    RecordProperty("buildMs", std::to_string(time.count()));
    EXPECT_LT(bvh.depth, 32u);
}

TEST(AccelBuild, SmallNumbers) {
    Random random(3);
    for (size_t count = 0; count <= 40; ++count) {
        std::vector<Aabb> bounds;
        for (size_t i = 0; i < count; ++i) bounds.push_back(cube(random.inCube(-1.0f, 1.0f), 0.01f));
        buildAndCheck(bounds);
    }
}

/// Full-sweep SAH cost by definition, recursively and in double: what binning approximates.
double sweepCost(std::vector<Aabb> boxes, const BvhConfig& config) {
    const auto area = [](const Aabb& box) { return static_cast<double>(box.halfArea()); };
    Aabb all;
    for (const Aabb& box : boxes) all.grow(box);
    const double leafCost = static_cast<double>(boxes.size()) * area(all);
    double best = std::numeric_limits<double>::infinity();
    int bestAxis = 0;
    size_t bestCount = 0;
    const auto sortAlong = [&](int axis) {
        std::stable_sort(boxes.begin(), boxes.end(),
                         [=](const Aabb& a, const Aabb& b) { return a.centroid()[axis] < b.centroid()[axis]; });
    };
    for (int axis = 0; axis < 3; ++axis) {
        sortAlong(axis);
        std::vector<double> right(boxes.size(), 0.0);
        Aabb box;
        for (size_t i = boxes.size() - 1; i > 0; --i) {
            box.grow(boxes[i]);
            right[i] = area(box) * static_cast<double>(boxes.size() - i);
        }
        box = Aabb();
        for (size_t i = 1; i < boxes.size(); ++i) {
            box.grow(boxes[i - 1]);
            const double cost = area(all) + area(box) * static_cast<double>(i) + right[i];
            if (cost < best) {
                best = cost;
                bestAxis = axis;
                bestCount = i;
            }
        }
    }
    if (boxes.size() <= static_cast<size_t>(config.maxLeafSize) && leafCost <= best) return leafCost;
    sortAlong(bestAxis);
    const auto middle = boxes.begin() + static_cast<std::ptrdiff_t>(bestCount);
    return area(all) + sweepCost({boxes.begin(), middle}, config) + sweepCost({middle, boxes.end()}, config);
}

TEST(AccelBuild, CostsLittleMoreThanAFullSweep) {
    for (const TestMesh& mesh : {accel_test::randomSoup(10000, 0.05f, 4), accel_test::randomSlivers(10000, 5),
                                 accel_test::sphere(2.0f, 70, 70, glm::vec3(0.0f))}) {
        const std::vector<Aabb> bounds = boundsOf(mesh);
        Aabb all;
        for (const Aabb& box : bounds) all.grow(box);
        const double reference = sweepCost(bounds, {}) / static_cast<double>(all.halfArea());
        EXPECT_LT(measureQuality(buildBinned(bounds)).sah, 1.03 * reference);
    }
}

TEST(AccelBuild, MillionEqualCentroids) {
    Random random(6);
    std::vector<Aabb> bounds(1000000);
    for (Aabb& box : bounds) box = cube(glm::vec3(0.0f), random.uniform(0.001f, 1.0f));
    const std::clock_t start = std::clock();
    const Bvh bvh = buildBinned(bounds);
    const double cpuSeconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    EXPECT_LT(cpuSeconds, 20.0) << "0.6 in a release build; the slack is for sanitizers";
    checkTree(bvh, bounds, {});
    EXPECT_LE(bvh.depth, 16u + 15u) << "halves down to 16, which the exact sweep may peel one by one";
}

TEST(AccelBuild, IdenticalBoxes) { buildAndCheck(std::vector<Aabb>(100000, cube(glm::vec3(1.0f, 2.0f, 3.0f), 0.5f))); }

TEST(AccelBuild, PointsAndFlatBoxes) {
    Random random(7);
    std::vector<Aabb> bounds(1000);
    for (Aabb& box : bounds) box = cube(random.inCube(-1.0f, 1.0f), 0.0f);
    buildAndCheck(bounds);
    for (Aabb& box : bounds) box.lo.y = box.hi.y = 0.0f;
    buildAndCheck(bounds);
    for (Aabb& box : bounds) box.lo.z = box.hi.z = 0.0f;
    buildAndCheck(bounds);
}

TEST(AccelBuild, GeometricSizesStayUnderTheDepthLimit) {
    // Each split by area separates the largest few from all the others: without a limit the tree is a list.
    std::vector<Aabb> bounds;
    for (int copy = 0; copy < 200; ++copy)
        for (int i = -60; i < 49; ++i) bounds.push_back(cube(glm::vec3(std::ldexp(1.5f, i)), std::ldexp(0.25f, i)));
    for (const int maxDepth : {13, 14, 20, 40, 62}) {
        BvhConfig config;
        config.maxDepth = maxDepth;
        buildAndCheck(bounds, config);
    }
}

TEST(AccelBuild, SortedStrips) {
    std::vector<Aabb> nested;
    std::vector<Aabb> shifted;
    for (int i = 0; i < 200000; ++i) {
        const auto x = static_cast<float>(i);
        nested.push_back({glm::vec3(0.0f), glm::vec3(x, 1.0f, 1.0f)});
        shifted.push_back({glm::vec3(x, 0.0f, 0.0f), glm::vec3(x + 1000.0f, 1.0f, 1e-3f)});
    }
    buildAndCheck(nested);
    buildAndCheck(shifted);
}

TEST(AccelBuild, TightDepthLimit) {
    const std::vector<Aabb> bounds = boundsOf(accel_test::randomSoup(1000, 0.1f, 8));
    BvhConfig config;
    config.maxDepth = 8;  // 4 * 2^8 = 1024
    buildAndCheck(bounds, config);
    config.maxDepth = 7;
    EXPECT_THROW(buildBinned(bounds, config), Error);
}

TEST(AccelBuild, LeavesOutWhatHasNoBox) {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    std::vector<Aabb> bounds = boundsOf(accel_test::randomSoup(1000, 0.1f, 9));
    const std::vector<Aabb> bad = {Aabb(),
                                   {glm::vec3(0.0f, kNan, 0.0f), glm::vec3(1.0f)},
                                   {glm::vec3(0.0f), glm::vec3(kNan)},
                                   {glm::vec3(-kInf), glm::vec3(kInf)},
                                   {glm::vec3(0.0f), glm::vec3(1.0f, kInf, 1.0f)},
                                   {glm::vec3(0.0f), glm::vec3(1e30f)}};
    for (size_t i = 0; i < bad.size(); ++i)
        bounds.insert(bounds.begin() + static_cast<std::ptrdiff_t>(i * 100), bad[i]);
    const Bvh bvh = buildBinned(bounds);
    checkTree(bvh, bounds, {});
    EXPECT_EQ(bvh.skipped, bad.size());
    const Bvh nothing = buildBinned(bad);
    EXPECT_TRUE(nothing.nodes.empty());
    EXPECT_EQ(nothing.skipped, bad.size());
}

TEST(AccelBuild, SameBytesForAnyNumberOfThreads) {
    std::vector<Aabb> zeros = boundsOf(accel_test::randomSoup(150000, 0.01f, 11));
    for (size_t i = 0; i < zeros.size(); ++i) zeros[i].lo.x = i % 3 == 0 ? -0.0f : 0.0f;  // min(-0, +0) is either
    const std::vector<std::vector<Aabb>> inputs = {boundsOf(accel_test::randomSoup(300000, 0.01f, 10)), zeros,
                                                   std::vector<Aabb>(150000, cube(glm::vec3(1.0f), 1.0f))};
    for (const std::vector<Aabb>& bounds : inputs) {
        std::optional<Bvh> reference;
        for (const size_t threads : {1u, 2u, 4u, 4u}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            const Bvh bvh = buildBinned(bounds);
            if (!reference) reference = bvh;
            EXPECT_EQ(bvh.order, reference->order);
            EXPECT_EQ(bvh.depth, reference->depth);
            ASSERT_EQ(bvh.nodes.size(), reference->nodes.size());
            EXPECT_EQ(0, std::memcmp(bvh.nodes.data(), reference->nodes.data(), bvh.nodes.size() * sizeof(BvhNode)));
        }
    }
}

TEST(AccelBuild, RejectsBadConfigs) {
    const std::vector<Aabb> bounds = {cube(glm::vec3(0.0f), 1.0f)};
    const auto rejects = [&](auto change) {
        BvhConfig config;
        change(config);
        EXPECT_THROW(buildBinned(bounds, config), Error);
    };
    rejects([](BvhConfig& c) { c.bins = 1; });
    rejects([](BvhConfig& c) { c.bins = kMaxBvhBins + 1; });
    rejects([](BvhConfig& c) { c.maxLeafSize = 0; });
    rejects([](BvhConfig& c) { c.maxLeafSize = kMaxLeafSize + 1; });
    rejects([](BvhConfig& c) { c.maxDepth = kMaxBvhDepth + 1; });
    rejects([](BvhConfig& c) { c.intersectionCost = 0.0f; });
    rejects([](BvhConfig& c) { c.traversalCost = std::numeric_limits<float>::quiet_NaN(); });
}

TEST(AccelTriangleBounds, KeepsWhatCanBeHitOnly) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInf = std::numeric_limits<float>::infinity();
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
