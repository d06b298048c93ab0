#include <glm/gtc/matrix_transform.hpp>

#include "engine/render/ray_caster.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_rays.h"

/// Light must not leak where triangles share edges and vertices: the cases that S1 (tests/stability) lacks.
namespace raylab::support {
namespace {

using accel_test::TestMesh;

constexpr size_t kEdgeRays = size_t{1} << 18;

using Watertight = GpuTest;

/// Rays that find no way to be stopped.
size_t countLeaks(Device& device, const Scene& scene, const RenderSettings& settings,
                  const std::vector<shared::RayData>& rays) {
    RayCaster caster(device, scene, settings);
    size_t leaks = 0;
    for (const shared::HitData& hit : caster.closest(rays)) leaks += hit.t < 0.0f ? 1u : 0u;
    return leaks;
}

TEST_F(Watertight, NoLeaksThroughManyBumps) {
    const TestMesh mesh = bumpyBall(200);
    EXPECT_EQ(countLeaks(device_, sceneOf(mesh), {}, raysAtEdges(mesh, glm::vec3(0.0f), kEdgeRays)), 0u);
}

TEST_F(Watertight, NoLeaksAwayFromTheOrigin) {
    const glm::vec3 centre(100.0f, 37.0f, -211.0f);
    for (const uint32_t rings : {50u, 200u}) {
        const TestMesh mesh = ball(rings, centre);
        EXPECT_EQ(countLeaks(device_, sceneOf(mesh), {}, raysAtEdges(mesh, centre, kEdgeRays)), 0u);
    }
}

/// Of one tree in world space, and of a tree below instances.
TEST_F(Watertight, NoLeaksOfATurnedInstance) {
    const glm::mat4 matrix =
        glm::rotate(glm::translate(glm::mat4(1.0f), {3.0f, -2.0f, 1.0f}), 1.1f, {0.4f, 1.0f, -0.7f});
    for (const uint32_t rings : {50u, 200u}) {
        const TestMesh mesh = ball(rings, glm::vec3(0.0f));
        Scene scene = sceneOf(mesh);
        scene.instances[0].objectToWorld = matrix;
        addInstance(scene, 0, glm::translate(glm::mat4(1.0f), {30.0f, 0.0f, 0.0f}));
        const std::vector<shared::RayData> rays = raysAtEdges(mesh, glm::vec3(0.0f), kEdgeRays, matrix);
        for (const RenderSettings& settings : {RenderSettings{}, twoLevels({})})
            EXPECT_EQ(countLeaks(device_, scene, settings, rays), 0u) << nameOf(settings);
    }
}

}  // namespace
}  // namespace raylab::support
