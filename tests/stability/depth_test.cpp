#include <algorithm>
#include <cmath>

#include "engine/accel/builders.h"
#include "engine/accel/triangle_bounds.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

/// S10: inputs that make deep trees. A stack that overflows loses hits.
namespace raylab::support {
namespace {

using accel_test::Random;
using accel_test::TestMesh;

using Depth = GpuTest;

/// The first corner opposite to the sum of the others: centroids at the origin, of all sizes.
TestMesh equalCentroids(size_t count) {
    Random random(121);
    TestMesh mesh;
    for (size_t i = 0; i < count; ++i) {
        const float size = std::pow(2.0f, random.uniform(-12.0f, 0.0f));
        const glm::vec3 a = size * random.direction(), b = size * random.direction();
        mesh.add(a, b, -a - b);
    }
    return mesh;
}

/// From 2^-30 on: the watertight test multiplies two lengths, and the product must not come close to denormals.
float geometricSize(size_t i) { return std::ldexp(1.0f, static_cast<int>(i % 60) - 30); }

TestMesh geometricSizes(size_t count) {
    Random random(122);
    TestMesh mesh;
    for (size_t i = 0; i < count; ++i) {
        const float size = geometricSize(i);
        const glm::vec3 p = size * random.direction();
        mesh.add(p, p + size * random.direction(), p + size * random.direction());
    }
    return mesh;
}

/// A strip whose triangles grow along X and are sorted by it.
TestMesh sortedStrip(size_t count) {
    TestMesh mesh;
    float x = 1.0f;
    for (size_t i = 0; i < count; ++i) {
        const float next = x * 1.005f;
        mesh.add({x, 0, 0}, {next, 0, 0.1f * x}, {x, 0.5f * x, 0});
        x = next;
    }
    return mesh;
}

void expectBoundedDepth(const TestMesh& mesh, int maxDepth, const char* what) {
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    for (const BuilderInfo& builder : builders()) {
        BvhConfig config;
        config.maxDepth = maxDepth;
        const Bvh bvh = buildBvh(builder.name, {bounds, mesh.positions, mesh.triangles}, config);
        EXPECT_LE(bvh.depth, static_cast<uint32_t>(maxDepth)) << what << " " << builder.name;
    }
}

TEST_F(Depth, BuildersKeepTheirCap) {
    expectBoundedDepth(equalCentroids(1'000'000), 40, "equal centroids");
    for (const int maxDepth : {16, 40}) {
        expectBoundedDepth(geometricSizes(20'000), maxDepth, "sizes 2^i");
        expectBoundedDepth(sortedStrip(10'000), maxDepth, "strip");
    }
}

/// Every layout finds what the oracle does, on the stack that its kernel was given.
void expectNoLostHits(Device& device, const Scene& scene, std::vector<shared::RayData> rays, double margin,
                      const char* what) {
    const OracleCase oracle(scene, std::move(rays), margin);
    for (const RenderSettings& settings : everyLayout()) {
        RayCaster caster(device, scene, settings);
        const Agreement agreement = compareWithOracle(caster, oracle);
        EXPECT_EQ(agreement.wrongHits, 0u) << what << " " << nameOf(settings);
        EXPECT_EQ(agreement.wrongShadows, 0u) << what << " " << nameOf(settings);
        EXPECT_GT(agreement.hits, oracle.rays.size() / 10) << what;
    }
}

TEST_F(Depth, NoHitIsLostAmongEqualCentroids) {
    const Scene scene = sceneOf(equalCentroids(20'000));
    expectNoLostHits(device_, scene, randomRays(scene, 1000, 123), 1e-3, "equal centroids");
}

TEST_F(Depth, NoHitIsLostAmongSizesOfPowersOfTwo) {
    const Scene scene = sceneOf(geometricSizes(900));
    Random random(124);
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < 10'000; ++i) {
        const glm::vec3 origin = geometricSize(i) * random.direction();
        rays.push_back(makeRay(origin, 1e-2f * glm::length(origin) * random.direction() - origin));
    }
    expectNoLostHits(device_, scene, std::move(rays), 1e-3, "sizes 2^i");
}

TEST_F(Depth, NoHitIsLostInASortedStrip) {
    const Scene scene = sceneOf(sortedStrip(2000));
    Random random(125);
    std::vector<shared::RayData> rays;
    for (int i = 0; i < 10'000; ++i) {
        const float x = std::pow(1.005f, random.uniform(1.0f, 1999.0f));
        const glm::vec3 target(x, random.uniform(0.0f, 0.4f) * x, 0.0f);
        rays.push_back(makeRay(target + x * glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), 2.0f), {0, 0, -1}));
        rays.back().direction = target - rays.back().origin;
    }
    expectNoLostHits(device_, scene, std::move(rays), 1e-3, "strip");
}

/// A detailed thing in a world 1e6 units wide.
TEST_F(Depth, NoHitIsLostOnADragonInAStadium) {
    const std::optional<TestMesh> dragon = accel_test::readDragon();
    if (!dragon) GTEST_SKIP() << accel_test::kNoDragon;
    Scene scene = sceneOf(*dragon);
    std::vector<shared::RayData> rays = randomRays(scene, 100, 126);
    addMesh(scene, floorQuad(0, 5e5f, -0.1f));
    addMesh(scene, floorQuad(0, 5e5f, 1e5f));
    expectNoLostHits(device_, scene, std::move(rays), 1e-3, "dragon");
}

}  // namespace
}  // namespace raylab::support
