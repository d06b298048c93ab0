#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/accel/builders.h"
#include "engine/accel/quality.h"
#include "engine/core/error.h"
#include "tests/unit/accel_build_support.h"

namespace raylab {
namespace {

using accel_test::boundsOf;
using accel_test::checkTree;
using accel_test::inputOf;
using accel_test::Random;
using accel_test::TestMesh;

double sahOf(std::string_view builder, const TestMesh& mesh, const BvhConfig& config = {}) {
    const std::vector<Aabb> bounds = boundsOf(mesh);
    return measureQuality(buildBvh(builder, inputOf(mesh, bounds), config), config).sah;
}

double halfArea(const Aabb& box) {
    const glm::dvec3 e = glm::dvec3(box.hi) - glm::dvec3(box.lo);
    return e.x * (e.y + e.z) + e.y * e.z;
}

struct NaiveSplit {
    double cost = std::numeric_limits<double>::infinity();  ///< sum over both sides of half area times count
    std::vector<Aabb> left;
    std::vector<Aabb> right;
};

/// The best of all planes at a centroid, by definition: O(n^2).
NaiveSplit naiveSplit(std::vector<Aabb> boxes) {
    NaiveSplit best;
    for (int axis = 0; axis < 3; ++axis) {
        std::stable_sort(boxes.begin(), boxes.end(), [=](const Aabb& a, const Aabb& b) {
            return a.lo[axis] + a.hi[axis] < b.lo[axis] + b.hi[axis];
        });
        for (size_t leftSize = 1; leftSize < boxes.size(); ++leftSize) {
            Aabb left;
            Aabb right;
            for (size_t i = 0; i < boxes.size(); ++i) (i < leftSize ? left : right).grow(boxes[i]);
            const double cost = halfArea(left) * static_cast<double>(leftSize) +
                                halfArea(right) * static_cast<double>(boxes.size() - leftSize);
            if (cost >= best.cost) continue;
            const auto middle = boxes.begin() + static_cast<std::ptrdiff_t>(leftSize);
            best = {cost, {boxes.begin(), middle}, {middle, boxes.end()}};
        }
    }
    return best;
}

/// Cost of the greedy tree by definition, times the root's area: a leaf where that is not dearer than the best split.
double naiveCost(const std::vector<Aabb>& boxes, const BvhConfig& config) {
    Aabb all;
    for (const Aabb& box : boxes) all.grow(box);
    const double leafCost = static_cast<double>(boxes.size()) * halfArea(all);
    if (boxes.size() == 1) return leafCost;
    const NaiveSplit split = naiveSplit(boxes);
    if (boxes.size() <= static_cast<size_t>(config.maxLeafSize) && leafCost <= halfArea(all) + split.cost)
        return leafCost;
    return halfArea(all) + naiveCost(split.left, config) + naiveCost(split.right, config);
}

std::vector<TestMesh> variedMeshes(size_t triangles) {
    return {accel_test::randomSoup(triangles, 0.05f, 21), accel_test::randomSlivers(triangles, 22),
            accel_test::sphere(2.0f, static_cast<uint32_t>(std::sqrt(triangles / 2)),
                               static_cast<uint32_t>(std::sqrt(triangles / 2)), glm::vec3(0.0f))};
}

size_t primitivesBelow(const Bvh& bvh, uint32_t index) {
    const BvhNode& node = bvh.nodes[index];
    return node.isLeaf() ? node.count : primitivesBelow(bvh, node.left) + primitivesBelow(bvh, node.left + 1);
}

TEST(AccelBuildSweep, FindsTheBestSplit) {
    for (const TestMesh& mesh : variedMeshes(500)) {
        const std::vector<Aabb> bounds = boundsOf(mesh);
        const Bvh bvh = buildBvh("sweep", inputOf(mesh, bounds));
        double cost = 0.0;
        for (const uint32_t child : {1u, 2u})
            cost += halfArea(bvh.nodes[child].bounds) * static_cast<double>(primitivesBelow(bvh, child));
        const double best = naiveSplit(bounds).cost;
        EXPECT_NEAR(cost, best, 1e-5 * best);
    }
}

TEST(AccelBuildSweep, CostsWhatTheGreedyTreeCosts) {
    for (const TestMesh& mesh : variedMeshes(1000)) {
        const std::vector<Aabb> bounds = boundsOf(mesh);
        const Bvh bvh = buildBvh("sweep", inputOf(mesh, bounds));
        // Ties, and differences in the last bit, are decided either way.
        EXPECT_NEAR(measureQuality(bvh).sah, naiveCost(bounds, {}) / halfArea(bvh.nodes[0].bounds),
                    2e-3 * measureQuality(bvh).sah);
    }
}

TEST(AccelBuildSweep, SharedBetweenThreadsFindsTheSame) {
    // Three hundred thousand boxes in a row, of two kinds: the best split is where the kind changes.
    std::vector<Aabb> bounds;
    constexpr size_t kLarge = 100003;
    for (size_t i = 0; i < 300000; ++i) {
        const auto x = static_cast<float>(i);
        const float height = i < kLarge ? 1e6f : 1.0f;
        bounds.push_back({{x, 0.0f, 0.0f}, {x + 1.0f, height, height}});
    }
    const Bvh bvh = buildBvh("sweep", {bounds, {}, {}});
    EXPECT_EQ(primitivesBelow(bvh, 1), kLarge);
}

TEST(AccelBuildBinned, CostsLittleMoreThanAFullSweep) {
    for (const TestMesh& mesh : variedMeshes(10000)) EXPECT_LT(sahOf("binned", mesh), 1.03 * sahOf("sweep", mesh));
}

TEST(AccelBuildLinear, CostsLittleMoreThanAFullSweep) {
    for (const TestMesh& mesh : variedMeshes(10000)) EXPECT_LT(sahOf("linear", mesh), 1.15 * sahOf("sweep", mesh));
}

/// A dragon in a stadium: cells of the whole are larger than the dragon.
TEST(AccelBuildLinear, SortsSmallThingsInALargeWorld) {
    const TestMesh dragon = accel_test::randomSoup(5000, 0.05f, 23);
    TestMesh stadium = dragon;
    stadium.add({-1e6f, -1e6f, -1e6f}, {-0.9e6f, -1e6f, -1e6f}, {-1e6f, -0.9e6f, -0.9e6f});
    stadium.add({1e6f, 1e6f, 1e6f}, {0.9e6f, 1e6f, 1e6f}, {1e6f, 0.9e6f, 0.9e6f});
    const auto areaBelowRoot = [](const TestMesh& mesh) {
        const std::vector<Aabb> bounds = boundsOf(mesh);
        const Bvh bvh = buildBvh("linear", inputOf(mesh, bounds));
        double area = 0.0;
        for (const BvhNode& node : bvh.nodes)
            if (halfArea(node.bounds) < 100.0) area += halfArea(node.bounds);
        return area;
    };
    EXPECT_LT(areaBelowRoot(stadium), 1.05 * areaBelowRoot(dragon));
}

/// Sorted by size, each box's nearest neighbour is the next smaller one, and only the smallest two are a pair: a turn
/// for each box, and a tree that is a list, if turns merged nothing else.
TEST(AccelBuildLinear, MergesNestedBoxesInFewTurns) {
    std::vector<Aabb> bounds;
    for (int i = 1; i <= 20000; ++i) bounds.push_back({glm::vec3(0.0f), glm::vec3(static_cast<float>(i), 1.0f, 1.0f)});
    BvhConfig config;
    config.maxDepth = kMaxBvhDepth;
    EXPECT_LT(buildBvh("linear", {bounds, {}, {}}, config).depth, 30u);
}

/// A height field of small triangles: boxes that touch, and hardly overlap.
TestMesh heightField(uint32_t size) {
    TestMesh mesh;
    const auto at = [&](uint32_t x, uint32_t y) {
        const glm::vec2 p = glm::vec2(x, y) / static_cast<float>(size);
        return glm::vec3(p, 0.1f * std::sin(9.0f * p.x) * std::cos(7.0f * p.y));
    };
    for (uint32_t y = 0; y < size; ++y)
        for (uint32_t x = 0; x < size; ++x) {
            mesh.add(at(x, y), at(x + 1, y), at(x + 1, y + 1));
            mesh.add(at(x, y), at(x + 1, y + 1), at(x, y + 1));
        }
    return mesh;
}

TEST(AccelBuildAuto, SplitsWhereBoxesOverlapAndNowhereElse) {
    const TestMesh beams = accel_test::longDiagonals(500, 24), field = heightField(64);
    const std::vector<Aabb> beamBounds = boundsOf(beams), fieldBounds = boundsOf(field);
    const Bvh split = buildBvh("auto", inputOf(beams, beamBounds)), whole = buildBvh("auto", inputOf(field, fieldBounds));
    EXPECT_GT(split.order.size(), beams.triangles.size());
    EXPECT_EQ(whole.order.size(), field.triangles.size());
    EXPECT_LT(sahOf("auto", beams), 0.6 * sahOf("binned", beams));
    // Where it does not split, that would have gained next to nothing.
    EXPECT_GT(sahOf("spatial", field), 0.97 * sahOf("auto", field));
}

TEST(AccelBuildSpatial, SplitsLongDiagonalTriangles) {
    const TestMesh mesh = accel_test::longDiagonals(500, 24);
    EXPECT_LT(sahOf("spatial", mesh), 0.6 * sahOf("binned", mesh));
}

TEST(AccelBuildSpatial, KeepsToItsBudget) {
    const TestMesh mesh = accel_test::longDiagonals(200, 25);
    const std::vector<Aabb> bounds = boundsOf(mesh);
    double before = std::numeric_limits<double>::infinity();
    for (const float budget : {0.0f, 0.05f, 0.2f, 0.5f}) {
        BvhConfig config;
        config.spatialBudget = budget;
        const Bvh bvh = buildBvh("spatial", inputOf(mesh, bounds), config);
        checkTree(bvh, bounds, config, budget == 0.0f);
        accel_test::checkCover(bvh, mesh, 20, 1e-7, 26);
        const double duplicates = static_cast<double>(bvh.order.size()) / static_cast<double>(bounds.size()) - 1.0;
        EXPECT_LE(duplicates, static_cast<double>(budget));
        EXPECT_GE(duplicates, 0.5 * static_cast<double>(budget)) << "the beams have use for it";
        const double sah = measureQuality(bvh, config).sah;
        EXPECT_LT(sah, before);
        before = sah;
    }
}

/// Far from the origin, where positions carry few bits, and with corners in the planes of splits.
TEST(AccelBuildSpatial, CoversTrianglesOfAllKinds) {
    TestMesh mesh = accel_test::longDiagonals(100, 27);
    for (glm::vec3& position : mesh.positions) position += glm::vec3(1000.0f, -500.0f, 0.0f);
    BvhConfig config;
    config.spatialBudget = 2.0f;
    const auto check = [&](const TestMesh& checked, double slack) {
        const std::vector<Aabb> bounds = boundsOf(checked);
        const Bvh bvh = buildBvh("spatial", inputOf(checked, bounds), config);
        EXPECT_GT(bvh.order.size(), bounds.size());
        checkTree(bvh, bounds, config, false);
        accel_test::checkCover(bvh, checked, 50, slack, 28);
    };
    check(mesh, 1e-12);
    Random random(29);
    const auto onGrid = [&] { return glm::floor(random.inCube(0.0f, 16.99f)); };
    TestMesh grid;
    for (int i = 0; i < 500; ++i) grid.add(onGrid(), onGrid(), onGrid());
    check(grid, 1e-12);
}

TEST(AccelBuildSpatial, WantsATriangleForEachBox) {
    const TestMesh mesh = accel_test::randomSoup(10, 0.1f, 30);
    const std::vector<Aabb> bounds(11, {glm::vec3(0.0f), glm::vec3(1.0f)});
    EXPECT_THROW(buildBvh("spatial", inputOf(mesh, bounds)), Error);
}

TEST(AccelBuildDragon, QualityAndDepth) {
    const std::optional<TestMesh> dragon = accel_test::readDragon();
    if (!dragon) GTEST_SKIP() << accel_test::kNoDragon;
    const std::vector<Aabb> bounds = boundsOf(*dragon);
    for (const std::string_view builder : {"binned", "linear"}) {
        const auto start = std::chrono::steady_clock::now();
        const Bvh bvh = buildBvh(builder, inputOf(*dragon, bounds));
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        checkTree(bvh, bounds);
        RecordProperty(std::string(builder) + "BuildMs", std::to_string(time.count()));
        EXPECT_LT(bvh.depth, 32u);
        EXPECT_LT(measureQuality(bvh).sah, 52.0) << "49.1 binned, 51.5 linear; 48.5 by a full sweep";
    }
}

}  // namespace
}  // namespace raylab
