#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/accel/builders.h"
#include "engine/accel/optimise.h"
#include "engine/accel/quality.h"
#include "engine/core/error.h"
#include "tests/unit/accel_build_support.h"

namespace raylab {
namespace {

using accel_test::boundsOf;
using accel_test::checkTree;
using accel_test::cube;
using accel_test::inputOf;
using accel_test::TestMesh;

TEST(AccelOptimise, LowersTheCostOfEveryBuildersTree) {
    const TestMesh mesh = accel_test::longDiagonals(200, 41);
    const std::vector<Aabb> bounds = boundsOf(mesh);
    for (const std::string& builder : builderNames()) {
        Bvh bvh = buildBvh(builder, inputOf(mesh, bounds));
        const double before = measureQuality(bvh).sah;
        const OptimiseResult result = optimise(bvh);
        const double after = measureQuality(bvh).sah;
        checkTree(bvh, bounds, {}, !accel_test::mayListAgain(builder));
        accel_test::checkCover(bvh, mesh, 20, 1e-7, 42);
        EXPECT_EQ(result.sahBefore, before);
        EXPECT_EQ(result.sahAfter, after);
        EXPECT_LT(after, 0.97 * before) << builder;
        EXPECT_GT(result.moves, 0u);
        EXPECT_TRUE(result.converged);
        EXPECT_GE(result.rounds, 16);
    }
}

TEST(AccelOptimise, BringsTogetherWhatBelongsTogether) {
    // Cubes at 0, 1, 100 and 101, paired across the gap.
    const auto at = [](float x) { return cube(glm::vec3(x, 0.0f, 0.0f), 0.5f); };
    const auto around = [](Aabb a, const Aabb& b) {
        a.grow(b);
        return a;
    };
    Bvh bvh;
    bvh.nodes = {{around(at(0), at(101)), 1, 0, 0},
                 {around(at(0), at(100)), 3, 0, 0},
                 {around(at(1), at(101)), 5, 0, 0},
                 {at(0), 0, 0, 1},
                 {at(100), 0, 1, 1},
                 {at(1), 0, 2, 1},
                 {at(101), 0, 3, 1}};
    bvh.order = {0, 1, 2, 3};
    bvh.depth = 2;
    BvhConfig config;
    config.maxLeafSize = 1;
    optimise(bvh, config);
    checkTree(bvh, std::vector{at(0), at(100), at(1), at(101)}, config);
    // Half areas: 205 of all, 5 of a pair, 3 of a cube.
    EXPECT_NEAR(measureQuality(bvh, config).sah, (205.0 + 2 * 5.0 + 4 * 3.0) / 205.0, 1e-6);
}

TEST(AccelOptimise, StaysUnderTheDepthLimit) {
    std::vector<Aabb> bounds;
    for (int copy = 0; copy < 40; ++copy)
        for (int i = -60; i < 49; ++i) bounds.push_back(cube(glm::vec3(std::ldexp(1.5f, i)), std::ldexp(0.25f, i)));
    for (const int maxDepth : {11, 13, 20}) {
        BvhConfig config;
        config.maxDepth = maxDepth;
        Bvh bvh = buildBvh("median", {bounds, {}, {}}, config);
        const OptimiseResult result = optimise(bvh, config);
        checkTree(bvh, bounds, config);
        EXPECT_LE(result.sahAfter, result.sahBefore);
    }
}

TEST(AccelOptimise, SameBytesForAnyNumberOfThreads) {
    const TestMesh mesh = accel_test::randomSoup(20000, 0.05f, 43);
    const std::vector<Aabb> bounds = boundsOf(mesh);
    const Bvh built = buildBvh("linear", inputOf(mesh, bounds));
    std::optional<Bvh> reference;
    for (const size_t threads : {1u, 2u, 4u}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Bvh bvh = built;
        EXPECT_EQ(optimise(bvh, {}, {.rounds = 6}).rounds, 6);
        if (!reference) reference = bvh;
        accel_test::expectSameBytes(bvh, *reference);
    }
}

TEST(AccelOptimise, KeepsToItsBudget) {
    const TestMesh mesh = accel_test::randomSoup(5000, 0.05f, 44);
    const std::vector<Aabb> bounds = boundsOf(mesh);
    const Bvh built = buildBvh("median", inputOf(mesh, bounds));
    Bvh bvh = built;
    EXPECT_EQ(optimise(bvh, {}, {.rounds = 0}).moves, 0u);
    EXPECT_EQ(optimise(bvh, {}, {.seconds = 0.0}).moves, 0u);
    double before = measureQuality(bvh).sah;
    for (const int rounds : {1, 4, 16}) {
        bvh = built;
        const OptimiseResult result = optimise(bvh, {}, {.rounds = rounds});
        EXPECT_EQ(result.rounds, rounds);
        EXPECT_LT(result.sahAfter, before);
        before = result.sahAfter;
    }
}

TEST(AccelOptimise, LeavesTheTreeAloneWhereCancelled) {
    const TestMesh mesh = accel_test::randomSoup(5000, 0.05f, 45);
    const std::vector<Aabb> bounds = boundsOf(mesh);
    Bvh bvh = buildBvh("median", inputOf(mesh, bounds));
    const Bvh before = bvh;
    std::atomic<bool> cancel = false;
    BuildControl control;
    control.cancel = &cancel;
    control.progress = [&](float) { cancel = true; };
    EXPECT_THROW(optimise(bvh, {}, {}, control), Cancelled);
    accel_test::expectSameBytes(bvh, before);
}

TEST(AccelOptimise, SmallTrees) {
    for (size_t size = 0; size < 12; ++size) {
        const TestMesh mesh = accel_test::randomSoup(size, 0.3f, 46);
        const std::vector<Aabb> bounds = boundsOf(mesh);
        BvhConfig config;
        config.maxLeafSize = 1;
        Bvh bvh = buildBvh("median", inputOf(mesh, bounds), config);
        const OptimiseResult result = optimise(bvh, config);
        EXPECT_LE(result.sahAfter, result.sahBefore);
        checkTree(bvh, bounds, config);
    }
    Bvh bvh;
    BvhConfig config;
    config.maxLeafSize = 0;
    EXPECT_THROW(optimise(bvh, config), Error);
}

}  // namespace
}  // namespace raylab
