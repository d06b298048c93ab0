#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "engine/accel/brute_force.h"
#include "engine/accel/build_binned.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/accel/triangle_watertight.h"
#include "engine/accel/walk_tree.h"
#include "tests/unit/accel_support.h"

/// The walk of every layout against brute force in double precision, and against each other.
namespace raylab {
namespace {

using accel_test::kNodeBase;
using accel_test::kSlotBase;
using accel_test::Random;
using accel_test::randomRays;
using accel_test::TestMesh;

struct FloatHit {
    float t = std::numeric_limits<float>::infinity();
    float u = 0.0f;
    float v = 0.0f;
    uint32_t primitive = kNoPrimitive;

    bool operator==(const FloatHit&) const = default;
};

/// Trees of a mesh: one for each size of leaves that the layouts hold.
class Trees {
public:
    explicit Trees(const TestMesh& mesh, const BvhConfig& config = {})
        : bounds_(triangleBounds(mesh.positions, mesh.triangles)), config_(config) {}

    const Bvh& of(const std::string& layout) {
        BvhConfig config = config_;
        config.maxLeafSize = std::min(config.maxLeafSize, findLayout(layout).maxLeafSize);
        const auto [place, added] = trees_.try_emplace(config.maxLeafSize);
        if (added) place->second = buildBinned(bounds_, config);
        return place->second;
    }

private:
    std::vector<Aabb> bounds_;
    BvhConfig config_;
    std::map<int, Bvh> trees_;
};

/// A mesh in one layout.
struct Traceable {
    const TestMesh& mesh;
    std::string layout;
    FlatTree tree;

    Traceable(const TestMesh& mesh_, Trees& trees, const std::string& layout_)
        : mesh(mesh_), layout(layout_), tree(flatten(layout_, trees.of(layout_), kNodeBase, kSlotBase)) {}

    /// The closest hit, of equal ones the lowest id: the same for every tree.
    FloatHit trace(const OracleRay& ray) const {
        FloatHit hit;
        float tMax = std::numeric_limits<float>::infinity();
        const WatertightRay watertight = makeWatertightRay(ray.o, ray.d);
        const auto testLeaf = [&](uint32_t first, uint32_t count) {
            for (uint32_t slot = first - kSlotBase; slot < first - kSlotBase + count; ++slot) {
                FloatHit found;
                found.primitive = tree.order[slot];
                const glm::uvec3& triangle = mesh.triangles[found.primitive];
                if (!intersectWatertight(watertight, mesh.positions[triangle.x], mesh.positions[triangle.y],
                                         mesh.positions[triangle.z], ray.tMin, tMax, found.t, found.u, found.v))
                    continue;
                if (found.t < hit.t || found.primitive < hit.primitive) hit = found;
                tMax = hit.t;
            }
        };
        const uint32_t highWater = walkTree(layout, tree, kNodeBase, ray.o, ray.d, ray.tMin, tMax, testLeaf);
        EXPECT_LE(highWater, tree.stackEntries) << layout;
        return hit;
    }
};

/// Every layout, where the oracle says that float arithmetic can decide: no edge and no second surface close by.
void expectAgreement(const TestMesh& mesh, const std::vector<OracleRay>& rays, double margin, size_t leastHits) {
    const std::vector<OracleHit> expected = closestHitsDouble(mesh.positions, mesh.triangles, rays);
    Trees trees(mesh);
    for (const std::string& layout : layoutNames()) {
        const Traceable scene(mesh, trees, layout);
        size_t hits = 0;
        size_t wrongHits = 0;
        size_t wrongDistances = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            const OracleHit& oracle = expected[i];
            if (oracle.margin < margin || (oracle.hit() && oracle.tNext < oracle.t * 1.0001)) continue;
            const FloatHit hit = scene.trace(rays[i]);
            hits += oracle.hit() ? 1 : 0;
            if (hit.primitive != oracle.primitive)
                ++wrongHits;
            else if (oracle.hit() && std::abs(static_cast<double>(hit.t) - oracle.t) > 1e-4 * oracle.t)
                ++wrongDistances;
        }
        EXPECT_EQ(wrongHits, 0u) << layout;
        EXPECT_EQ(wrongDistances, 0u) << layout;
        EXPECT_GT(hits, leastHits) << layout;
    }
}

TEST(AccelLayoutWalks, RandomSoupAgreesWithOracle) {
    const TestMesh mesh = accel_test::randomSoup(2000, 0.1f, 71);
    expectAgreement(mesh, randomRays({glm::vec3(0.0f), glm::vec3(1.0f)}, 8000, 72), 1e-4, 2000);
}

TEST(AccelLayoutWalks, SliversAgreeWithOracle) {
    const TestMesh mesh = accel_test::randomSlivers(2000, 73);
    expectAgreement(mesh, randomRays({glm::vec3(0.0f), glm::vec3(1.0f)}, 8000, 74), 0.01, 100);
}

TEST(AccelLayoutWalks, SphereAgreesWithOracle) {
    const TestMesh mesh = accel_test::sphere(1.0f, 24, 48, {10.0f, -20.0f, 5.0f});
    expectAgreement(mesh, randomRays({{9.0f, -21.0f, 4.0f}, {11.0f, -19.0f, 6.0f}}, 8000, 75), 1e-3, 2000);
}

TEST(AccelLayoutWalks, RaysAlongAxesAndInFacesAgreeWithOracle) {
    expectAgreement(accel_test::gridOfCubes(), accel_test::raysAlongAxes(8000, 76), 1e-4, 500);
}

/// Also where a ray runs along an edge, which no oracle decides.
TEST(AccelLayoutWalks, RaysAlongAxesAndInFacesAreTheSameInAllLayouts) {
    const TestMesh mesh = accel_test::gridOfCubes();
    Trees trees(mesh);
    const std::vector<OracleRay> rays = accel_test::raysAlongAxes(20000, 77);
    const Traceable first(mesh, trees, "bvh2");
    for (const std::string& layout : layoutNames()) {
        if (layout == first.layout) continue;
        const Traceable scene(mesh, trees, layout);
        size_t different = 0;
        for (const OracleRay& ray : rays) different += scene.trace(ray) == first.trace(ray) ? 0 : 1;
        EXPECT_EQ(different, 0u) << layout;
    }
}

TEST(AccelLayoutWalks, DragonIsTheSameInAllLayouts) {
    const std::optional<TestMesh> dragon = accel_test::readDragon();
    if (!dragon) GTEST_SKIP() << accel_test::kNoDragon;
    Trees trees(*dragon);
    const std::vector<OracleRay> rays = randomRays(trees.of("bvh2").nodes[0].bounds, 100000, 78);
    const Traceable first(*dragon, trees, "bvh2");
    std::vector<FloatHit> expected;
    size_t hits = 0;
    for (const OracleRay& ray : rays) {
        expected.push_back(first.trace(ray));
        hits += expected.back().primitive != kNoPrimitive ? 1 : 0;
    }
    EXPECT_GT(hits, rays.size() / 10);
    for (const std::string& layout : layoutNames()) {
        if (layout == first.layout) continue;
        const Traceable scene(*dragon, trees, layout);
        size_t different = 0;
        for (size_t i = 0; i < rays.size(); ++i) different += scene.trace(rays[i]) == expected[i] ? 0 : 1;
        EXPECT_EQ(different, 0u) << layout;
    }
}

/// S1 of the stability battery: from inside a closed sphere, at vertices and at points of edges.
size_t countLeaks(const Traceable& scene, const glm::vec3& center, size_t count) {
    Random random(79);
    size_t leaks = 0;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 o = center + random.inCube(-0.9f, 0.9f);
        const auto triangleCount = static_cast<uint32_t>(scene.mesh.triangles.size());
        const glm::uvec3& triangle = scene.mesh.triangles[random.below(triangleCount)];
        const auto corner = static_cast<int>(random.below(3));
        const glm::vec3& a = scene.mesh.positions[triangle[corner]];
        const glm::vec3& b = scene.mesh.positions[triangle[(corner + 1) % 3]];
        const glm::vec3 target = i % 2 == 0 ? a : a + random.uniform(0.0f, 1.0f) * (b - a);
        const glm::vec3 d = i % 3 == 0 ? target - o : glm::normalize(target - o);
        leaks += scene.trace({o, d}).primitive == kNoPrimitive ? 1 : 0;
    }
    return leaks;
}

TEST(AccelLayoutWalks, NoLeaks) {
    for (const glm::vec3& center : {glm::vec3(0.0f), glm::vec3(100.0f, 37.0f, -211.0f)}) {
        const TestMesh mesh = accel_test::sphere(2.0f, 50, 100, center);
        Trees trees(mesh);
        for (const std::string& layout : layoutNames())
            EXPECT_EQ(countLeaks(Traceable(mesh, trees, layout), center, 200000), 0u) << layout;
    }
}

/// Triangles of sizes 2^i about the origin: trees as deep as the builder allows.
TEST(AccelLayoutWalks, DeepTreesStayWithinTheirStack) {
    Random random(80);
    TestMesh mesh;
    for (int i = 0; i < 3000; ++i) {
        const float size = std::ldexp(1.0f, i % 90 - 60);
        const glm::vec3 p = size * random.direction();
        mesh.add(p, p + size * random.direction(), p + size * random.direction());
    }
    for (const int maxDepth : {20, kMaxBvhDepth}) {
        BvhConfig config;
        config.maxDepth = maxDepth;
        Trees trees(mesh, config);
        for (const std::string& layout : layoutNames()) {
            const Traceable scene(mesh, trees, layout);
            size_t hits = 0;
            for (int i = 0; i < 2000; ++i) {
                const glm::vec3 o = std::ldexp(1.0f, i % 90 - 60) * random.direction();
                const glm::vec3 target = 1e-3f * glm::length(o) * random.direction();
                hits += scene.trace({o, target - o}).primitive != kNoPrimitive ? 1 : 0;  // checks the high-water mark
            }
            EXPECT_GT(hits, 400u) << layout;
        }
    }
}

TEST(AccelLayoutWalks, RespectTMinAndEndEarly) {
    const TestMesh mesh = accel_test::sphere(1.0f, 20, 20, glm::vec3(0.0f));
    Trees trees(mesh);
    for (const std::string& layout : layoutNames()) {
        const Traceable scene(mesh, trees, layout);
        OracleRay ray{{0.05f, 0.02f, -3.0f}, {0.0f, 0.0f, 1.0f}};
        EXPECT_NEAR(scene.trace(ray).t, 2.0f, 0.03f);
        ray.tMin = 2.5f;
        EXPECT_NEAR(scene.trace(ray).t, 4.0f, 0.03f);
        size_t slots = 0;
        float tMax = 10.0f;
        const auto stop = [&](uint32_t, uint32_t count) {
            slots += count;
            tMax = -1.0f;
        };
        walkTree(layout, scene.tree, kNodeBase, ray.o, ray.d, 0.0f, tMax, stop);
        EXPECT_GE(slots, 1u);
        EXPECT_LE(slots, 24u) << "tMax below tMin ends the walk, but for the leaves of one node";
    }
}

}  // namespace
}  // namespace raylab
