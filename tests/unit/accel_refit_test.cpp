#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <limits>
#include <optional>

#include "engine/accel/builders.h"
#include "engine/accel/refit.h"
#include "tests/unit/accel_build_support.h"

namespace raylab {
namespace {

using accel_test::boundsOf;
using accel_test::inputOf;
using accel_test::Random;
using accel_test::TestMesh;

/// The box of all primitives below a node, one by one.
Aabb boxBelow(const Bvh& bvh, std::span<const Aabb> bounds, uint32_t index) {
    const BvhNode& node = bvh.nodes[index];
    Aabb box;
    for (uint32_t slot = node.first; slot < node.first + node.count; ++slot) box.grow(bounds[bvh.order[slot]]);
    if (node.isLeaf()) return box;
    box.grow(boxBelow(bvh, bounds, node.left));
    box.grow(boxBelow(bvh, bounds, node.left + 1));
    return box;
}

std::vector<Aabb> movedBoxes(std::vector<Aabb> bounds, uint32_t seed) {
    Random random(seed);
    for (Aabb& box : bounds) {
        const glm::vec3 shift = random.inCube(-0.5f, 0.5f);
        box = {box.lo + shift, box.hi + shift + random.inCube(0.0f, 0.1f)};
    }
    return bounds;
}

TEST(AccelRefit, GivesTheBoxesOfWhatIsBelow) {
    for (const size_t size : {1u, 3u, 5000u, 60000u}) {
        const TestMesh mesh = accel_test::randomSoup(size, 0.02f, 61);
        const std::vector<Aabb> bounds = boundsOf(mesh);
        const std::vector<Aabb> moved = movedBoxes(bounds, 62);
        for (const std::string& builder : builderNames()) {
            Bvh bvh = buildBvh(builder, inputOf(mesh, bounds));
            const Bvh before = bvh;
            refit(bvh, moved);
            EXPECT_EQ(bvh.order, before.order);
            for (uint32_t i = 0; i < bvh.nodes.size(); i += size < 10000 ? 1 : 97) {
                const Aabb expected = boxBelow(bvh, moved, i);
                EXPECT_EQ(bvh.nodes[i].bounds.lo, expected.lo);
                EXPECT_EQ(bvh.nodes[i].bounds.hi, expected.hi);
                EXPECT_EQ(bvh.nodes[i].left, before.nodes[i].left);
                EXPECT_EQ(bvh.nodes[i].count, before.nodes[i].count);
            }
        }
    }
}

TEST(AccelRefit, SameBytesForAnyNumberOfThreads) {
    const TestMesh mesh = accel_test::randomSoup(100000, 0.02f, 63);
    const std::vector<Aabb> bounds = boundsOf(mesh);
    const std::vector<Aabb> moved = movedBoxes(bounds, 64);
    const Bvh built = buildBvh("linear", inputOf(mesh, bounds));
    std::optional<Bvh> reference;
    for (const size_t threads : {1u, 2u, 4u}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Bvh bvh = built;
        refit(bvh, moved);
        if (!reference) reference = bvh;
        accel_test::expectSameBytes(bvh, *reference);
    }
}

TEST(AccelRefit, LeavesOutWhatHasNoBoxAnyMore) {
    const TestMesh mesh = accel_test::randomSoup(500, 0.02f, 65);
    const std::vector<Aabb> bounds = boundsOf(mesh);
    BvhConfig config;
    config.maxLeafSize = 1;
    Bvh bvh = buildBvh("binned", inputOf(mesh, bounds), config);
    const Bvh before = bvh;
    std::vector<Aabb> moved = bounds;
    moved[7].lo.x = std::numeric_limits<float>::quiet_NaN();
    moved[11] = Aabb();
    refit(bvh, moved);
    accel_test::expectSameBytes(bvh, before);  // leaves of one keep the boxes that they had
    config.maxLeafSize = 16;
    config.traversalCost = 100.0f;
    bvh = buildBvh("binned", inputOf(mesh, bounds), config);
    refit(bvh, moved);
    for (const BvhNode& node : bvh.nodes) {
        Aabb box;
        for (uint32_t slot = node.first; slot < node.first + node.count; ++slot)
            if (moved[bvh.order[slot]].usable()) box.grow(moved[bvh.order[slot]]);
        EXPECT_TRUE(!node.isLeaf() || (node.bounds.lo == box.lo && node.bounds.hi == box.hi));
    }
}

TEST(AccelRefit, EmptyTree) {
    Bvh bvh;
    refit(bvh, {});
    EXPECT_TRUE(bvh.nodes.empty());
}

}  // namespace
}  // namespace raylab
