#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/accel/brute_force.h"
#include "engine/accel/build_binned.h"
#include "engine/accel/layout_bvh2q.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/accel/triangle_watertight.h"
#include "engine/accel/walk_bvh2q.h"
#include "tests/unit/accel_support.h"

namespace raylab {
namespace {

using accel_test::kNodeBase;
using accel_test::kSlotBase;
using accel_test::Random;
using accel_test::randomRays;
using accel_test::TestMesh;

struct Bvh2qHit {
    float t = std::numeric_limits<float>::infinity();
    float u = 0.0f;
    float v = 0.0f;
    uint32_t primitive = kNoPrimitive;
};

/// Mesh, tree and what the kernels read, with bases that are not zero.
struct Bvh2qScene {
    const TestMesh& mesh;
    Bvh bvh;
    TreeBvh2q tree;

    explicit Bvh2qScene(const TestMesh& mesh_, const BvhConfig& config = {})
        : mesh(mesh_),
          bvh(buildBinned(triangleBounds(mesh.positions, mesh.triangles), config)),
          tree(flattenBvh2q(bvh, kNodeBase, kSlotBase)) {}

    Bvh2qHit trace(const OracleRay& ray) const {
        Bvh2qHit hit;
        float tMax = std::numeric_limits<float>::infinity();
        const WatertightRay watertight = makeWatertightRay(ray.o, ray.d);
        const auto testLeaf = [&](uint32_t first, uint32_t count) {
            for (uint32_t slot = first - kSlotBase; slot < first - kSlotBase + count; ++slot) {
                const uint32_t id = bvh.order[slot];
                const glm::uvec3& triangle = mesh.triangles[id];
                if (intersectWatertight(watertight, mesh.positions[triangle.x], mesh.positions[triangle.y],
                                        mesh.positions[triangle.z], ray.tMin, tMax, hit.t, hit.u, hit.v)) {
                    tMax = hit.t;
                    hit.primitive = id;
                }
            }
        };
        const uint32_t highWater = walkBvh2q(tree.nodes, tree.grid, kNodeBase, ray.o, ray.d, ray.tMin, tMax, testLeaf);
        EXPECT_LE(highWater, tree.depth);
        return hit;
    }
};

struct Agreement {
    size_t decidable = 0;
    size_t hits = 0;
    size_t wrongHits = 0;
    size_t wrongDistances = 0;
};

/// Compares where the oracle says that float arithmetic can decide: no edge and no second surface close by.
Agreement compareWithOracle(const Bvh2qScene& scene, const std::vector<OracleRay>& rays, double margin) {
    const std::vector<OracleHit> expected = closestHitsDouble(scene.mesh.positions, scene.mesh.triangles, rays);
    Agreement agreement;
    for (size_t i = 0; i < rays.size(); ++i) {
        const OracleHit& oracle = expected[i];
        if (oracle.margin < margin || (oracle.hit() && oracle.tNext < oracle.t * 1.0001)) continue;
        ++agreement.decidable;
        agreement.hits += oracle.hit() ? 1u : 0u;
        const Bvh2qHit hit = scene.trace(rays[i]);
        if (hit.primitive != oracle.primitive)
            ++agreement.wrongHits;
        else if (oracle.hit() && std::abs(static_cast<double>(hit.t) - oracle.t) > 1e-4 * oracle.t)
            ++agreement.wrongDistances;
    }
    return agreement;
}

void expectAgreement(const Bvh2qScene& scene, const std::vector<OracleRay>& rays, double margin) {
    const Agreement agreement = compareWithOracle(scene, rays, margin);
    EXPECT_EQ(agreement.wrongHits, 0u);
    EXPECT_EQ(agreement.wrongDistances, 0u);
    EXPECT_GT(agreement.decidable, rays.size() * 3 / 4) << "too few rays left to mean anything";
    EXPECT_GT(agreement.hits, rays.size() / 20);
}

TEST(AccelTriangle, ClosedForm) {
    const glm::vec3 p0(1, 1, 5);
    const glm::vec3 p1(3, 1, 5);
    const glm::vec3 p2(1, 5, 5);
    // At (1.5, 2, 5): u = 0.25 along p1, v = 0.25 along p2; d = (0, 0, 2) halves t.
    const WatertightRay ray = makeWatertightRay({1.5f, 2.0f, 1.0f}, {0.0f, 0.0f, 2.0f});
    float t = 0.0f;
    float u = 0.0f;
    float v = 0.0f;
    ASSERT_TRUE(intersectWatertight(ray, p0, p1, p2, 0.0f, 10.0f, t, u, v));
    EXPECT_FLOAT_EQ(t, 2.0f);
    EXPECT_FLOAT_EQ(u, 0.25f);
    EXPECT_FLOAT_EQ(v, 0.25f);
    EXPECT_TRUE(intersectWatertight(ray, p0, p2, p1, 0.0f, 2.0f, t, u, v)) << "from behind, and at tMax";
    EXPECT_FALSE(intersectWatertight(ray, p0, p1, p2, 2.0f, 10.0f, t, u, v)) << "at tMin";
    EXPECT_FALSE(intersectWatertight(ray, p0, p1, p2, 0.0f, 1.99f, t, u, v));
    EXPECT_FALSE(
        intersectWatertight(makeWatertightRay({1.5f, 2.0f, 1.0f}, {0, 0, -1}), p0, p1, p2, 0.0f, 10.0f, t, u, v));
    EXPECT_FALSE(
        intersectWatertight(makeWatertightRay({2.5f, 3.0f, 1.0f}, {0, 0, 1}), p0, p1, p2, 0.0f, 10.0f, t, u, v));
    EXPECT_FALSE(intersectWatertight(makeWatertightRay({0, 2, 5}, {1, 0, 0}), p0, p1, p2, 0.0f, 10.0f, t, u, v))
        << "in its plane";
}

TEST(AccelTriangle, DistanceIsThatOfThePlaneHoweverLargeTheTriangle) {
    const glm::vec3 p0(-1e4f, 0, -1e4f), p1(1e4f, 0, -1e4f), p2(0, 0, 1e4f);
    // From a height of 2^-10 down by 2^-6 a unit: at 2^-4. The vertices' distances round at 1e4 * 2^-24 = 6e-4.
    const WatertightRay ray = makeWatertightRay({0.3f, 0x1p-10f, 0.2f}, {0.9f, -0x1p-6f, 0.4f});
    float t = 0.0f, u = 0.0f, v = 0.0f;
    ASSERT_TRUE(intersectWatertight(ray, p0, p1, p2, 0.0f, 1.0f, t, u, v));
    EXPECT_FLOAT_EQ(t, 0x1p-4f);
}

TEST(AccelTriangle, EveryOrderOfVerticesGivesTheSameDistance) {
    Random random(41);
    size_t hits = 0;
    for (int i = 0; i < 20000; ++i) {
        std::array<glm::vec3, 3> p = {random.inCube(-1, 1), random.inCube(-1, 1), random.inCube(-1, 1)};
        const glm::vec3 o = random.inCube(-2, 2);
        const WatertightRay ray = makeWatertightRay(o, (p[0] + p[1] + p[2]) / 3.0f - o + random.inCube(-0.5f, 0.5f));
        std::array<int, 3> order = {0, 1, 2};
        float first = 0.0f;
        const bool hit = intersectWatertight(ray, p[0], p[1], p[2], 0.0f, 10.0f, first, first, first);
        do {
            float t = 0.0f;
            float u = 0.0f;
            float v = 0.0f;
            EXPECT_EQ(hit, intersectWatertight(ray, p[order[0]], p[order[1]], p[order[2]], 0.0f, 10.0f, t, u, v));
            if (hit && order[0] == 0 && order[1] == 1) first = t;
            if (hit) {
                EXPECT_NEAR(t, first, std::abs(first) * 1.2e-7f) << "one ulp";
            }
        } while (std::next_permutation(order.begin(), order.end()));
        hits += hit ? 1 : 0;
    }
    EXPECT_GT(hits, 5000u);
}

TEST(AccelOracle, ClosedForm) {
    TestMesh mesh;
    mesh.add({-1, -1, 3}, {3, -1, 3}, {-1, 3, 3});
    mesh.add({-1, -1, 2}, {3, -1, 2}, {-1, 3, 2});
    mesh.add({-1, -1, 2}, {3, -1, 2}, {-1, 3, 2});
    const OracleHit hit = closestHitDouble(mesh.positions, mesh.triangles, {0, 0, 0}, {0, 0, 0.5f}, 0.0f);
    EXPECT_EQ(hit.primitive, 1u) << "of two equal ones the lowest id";
    EXPECT_DOUBLE_EQ(hit.t, 4.0);
    EXPECT_DOUBLE_EQ(hit.tNext, 4.0);
    EXPECT_DOUBLE_EQ(hit.u, 0.25);
    EXPECT_DOUBLE_EQ(hit.v, 0.25);
    EXPECT_DOUBLE_EQ(hit.margin, 0.25);
    EXPECT_EQ(closestHitDouble(mesh.positions, mesh.triangles, {0, 0, 0}, {0, 0, 0.5f}, 4.0f).primitive, 0u);
    const OracleHit miss = closestHitDouble(mesh.positions, mesh.triangles, {1.1f, 1.0f, 0}, {0, 0, 1}, 0.0f);
    EXPECT_FALSE(miss.hit());
    EXPECT_NEAR(miss.margin, 0.025, 1e-6) << "a near miss is not decidable either";
}

TEST(AccelTrace, RandomSoupAgreesWithOracle) {
    const TestMesh mesh = accel_test::randomSoup(3000, 0.1f, 42);
    const Bvh2qScene scene(mesh);
    expectAgreement(scene, randomRays(scene.bvh.nodes[0].bounds, 15000, 43), 1e-4);
}

TEST(AccelTrace, SliversAgreeWithOracle) {
    const TestMesh mesh = accel_test::randomSlivers(3000, 44);
    const Bvh2qScene scene(mesh);
    // A sliver is 5e-4 wide and a few units away: its width carries 1e-3 of rounding in places.
    const Agreement agreement = compareWithOracle(scene, randomRays(scene.bvh.nodes[0].bounds, 8000, 45), 0.01);
    EXPECT_EQ(agreement.wrongHits, 0u);
    EXPECT_EQ(agreement.wrongDistances, 0u);
    EXPECT_GT(agreement.hits, 200u);
}

TEST(AccelTrace, DragonAgreesWithOracle) {
    const std::optional<TestMesh> dragon = accel_test::readDragon();
    if (!dragon) GTEST_SKIP() << accel_test::kNoDragon;
    const Bvh2qScene whole(*dragon);
    // Triangles of 5e-4 seen from 0.3: positions carry 1e-4 of their size.
    expectAgreement(whole, randomRays(whole.bvh.nodes[0].bounds, 100, 46), 2e-3);
    TestMesh head;
    head.positions = dragon->positions;
    std::copy_n(dragon->triangles.begin(), 8000, std::back_inserter(head.triangles));
    const Bvh2qScene part(head);
    expectAgreement(part, randomRays(part.bvh.nodes[0].bounds, 6000, 47), 2e-3);
}

TEST(AccelTrace, RaysAlongAxesAndInFacesAgreeWithOracle) {
    const TestMesh mesh = accel_test::gridOfCubes();
    const Bvh2qScene scene(mesh);
    const Agreement agreement = compareWithOracle(scene, accel_test::raysAlongAxes(20000, 48), 1e-4);
    EXPECT_EQ(agreement.wrongHits, 0u);
    EXPECT_EQ(agreement.wrongDistances, 0u);
    EXPECT_GT(agreement.hits, 1000u);
}

TEST(AccelTrace, RespectsTMinAndEndsEarly) {
    const TestMesh mesh = accel_test::sphere(1.0f, 20, 20, glm::vec3(0.0f));
    const Bvh2qScene scene(mesh);
    OracleRay ray{{0.05f, 0.02f, -3.0f}, {0.0f, 0.0f, 1.0f}};
    EXPECT_NEAR(scene.trace(ray).t, 2.0f, 0.03f);
    ray.tMin = 2.5f;
    EXPECT_NEAR(scene.trace(ray).t, 4.0f, 0.03f);
    size_t leaves = 0;
    float tMax = 10.0f;
    const auto stop = [&](uint32_t, uint32_t) {
        ++leaves;
        tMax = -1.0f;
    };
    walkBvh2q(scene.tree.nodes, scene.tree.grid, kNodeBase, ray.o, ray.d, 0.0f, tMax, stop);
    EXPECT_EQ(leaves, 1u) << "tMax below tMin ends the walk, but for leaves already on the stack";
}

/// S1 of the stability battery: from inside a closed sphere, at vertices and at points of edges.
size_t countLeaks(const glm::vec3& center, uint32_t rings, size_t count) {
    const TestMesh mesh = accel_test::sphere(2.0f, rings, 2 * rings, center);
    const Bvh2qScene scene(mesh);
    Random random(49);
    size_t leaks = 0;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 o = center + random.inCube(-0.9f, 0.9f);
        const glm::uvec3& triangle = mesh.triangles[random.below(static_cast<uint32_t>(mesh.triangles.size()))];
        const auto corner = static_cast<int>(random.below(3));
        const glm::vec3& a = mesh.positions[triangle[corner]];
        const glm::vec3& b = mesh.positions[triangle[(corner + 1) % 3]];
        const glm::vec3 target = i % 2 == 0 ? a : a + random.uniform(0.0f, 1.0f) * (b - a);
        const glm::vec3 d = i % 3 == 0 ? target - o : glm::normalize(target - o);
        leaks += scene.trace({o, d}).primitive == kNoPrimitive ? 1 : 0;
    }
    return leaks;
}

TEST(AccelTrace, NoLeaksAtTheOrigin) {
    EXPECT_EQ(countLeaks(glm::vec3(0.0f), 50, 100000), 0u);
    EXPECT_EQ(countLeaks(glm::vec3(0.0f), 200, 100000), 0u);
}

TEST(AccelTrace, NoLeaksFarFromTheOrigin) {
    EXPECT_EQ(countLeaks({100.0f, 37.0f, -211.0f}, 50, 100000), 0u);
    EXPECT_EQ(countLeaks({100.0f, 37.0f, -211.0f}, 200, 100000), 0u);
}

}  // namespace
}  // namespace raylab
