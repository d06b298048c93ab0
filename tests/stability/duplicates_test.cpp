#include <cstring>

#include "engine/accel/builders.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/core/stopwatch.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

/// S9: 10,000 identical triangles.
namespace raylab::support {
namespace {

using accel_test::Random;
using accel_test::TestMesh;

using Duplicates = GpuTest;

TestMesh identicalTriangles(size_t count) {
    TestMesh mesh;
    for (size_t i = 0; i < count; ++i) mesh.add({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
    return mesh;
}

bool isSameTree(const Bvh& a, const Bvh& b) {
    return a.order == b.order && a.depth == b.depth && a.nodes.size() == b.nodes.size() &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0;
}

TEST_F(Duplicates, BuildFastAndTheSameTenTimes) {
    const TestMesh mesh = identicalTriangles(10'000);
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    for (const BuilderInfo& builder : builders()) {
        const Stopwatch watch;
        const Bvh first = buildBvh(builder.name, {bounds, mesh.positions, mesh.triangles});
        EXPECT_LT(watch.seconds(), 5.0) << builder.name;
        for (int run = 1; run < 10; ++run)
            EXPECT_TRUE(isSameTree(buildBvh(builder.name, {bounds, mesh.positions, mesh.triangles}), first))
                << builder.name;
    }
}

TEST_F(Duplicates, LowestIdWins) {
    const Scene scene = sceneOf(identicalTriangles(10'000));
    Random random(88);
    std::vector<shared::RayData> rays;
    for (int i = 0; i < 64; ++i)
        rays.push_back(makeRay({random.uniform(-0.4f, 0.9f), random.uniform(-0.4f, 0.9f), 2.0f}, {0, 0, -1}));
    std::vector<RenderSettings> choices = everyLayout();
    for (const BuilderInfo& builder : builders()) {
        choices.emplace_back();
        choices.back().builder = builder.name;
    }
    for (const RenderSettings& settings : choices) {
        RayCaster caster(device_, scene, settings);
        for (const shared::HitData& hit : caster.closest(rays)) {
            EXPECT_EQ(hit.t, 2.0f) << nameOf(settings);
            EXPECT_EQ(hit.primitive, 0u) << nameOf(settings);
        }
    }
}

}  // namespace
}  // namespace raylab::support
