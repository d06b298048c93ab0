#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/render/ray_caster.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// S1: light must not leak where triangles share edges and vertices.
namespace raylab::support {
namespace {

using accel_test::Random;
using accel_test::TestMesh;

constexpr size_t kRays = size_t{1} << 18;

/// Rays from around the centre at vertices and at points of edges, in turn; `toWorld` moves both.
std::vector<shared::RayData> raysAtEdges(const TestMesh& mesh, const glm::vec3& centre, const glm::mat4& toWorld) {
    Random random(91);
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < kRays; ++i) {
        const glm::vec3 origin = centre + random.inCube(-0.9f, 0.9f);
        const glm::uvec3& triangle = mesh.triangles[random.below(static_cast<uint32_t>(mesh.triangles.size()))];
        const auto corner = static_cast<int>(random.below(3));
        const glm::vec3& a = mesh.positions[triangle[corner]];
        const glm::vec3& b = mesh.positions[triangle[(corner + 1) % 3]];
        const glm::vec3 target = i % 2 == 0 ? a : a + random.uniform(0.0f, 1.0f) * (b - a);
        const glm::vec3 from(toWorld * glm::vec4(origin, 1.0f));
        const glm::vec3 direction = glm::vec3(toWorld * glm::vec4(target, 1.0f)) - from;
        rays.push_back(makeRay(from, i % 3 == 0 ? direction : glm::normalize(direction)));
    }
    return rays;
}

/// Rays that find no way to be stopped. `instanced`: the sphere is turned and shown twice.
size_t countLeaks(Device& device, const TestMesh& mesh, const glm::vec3& centre, bool instanced = false) {
    Scene scene;
    glm::mat4 matrix(1.0f);
    if (instanced)
        matrix = glm::rotate(glm::translate(glm::mat4(1.0f), {3.0f, -2.0f, 1.0f}), 1.1f, {0.4f, 1.0f, -0.7f});
    const uint32_t index = addMesh(scene, meshOf(mesh, addMaterial(scene, lambert(0.5f))), matrix);
    if (instanced) addInstance(scene, index, glm::translate(glm::mat4(1.0f), {30.0f, 0.0f, 0.0f}));
    RayCaster caster(device, scene, {});
    const std::vector<shared::RayData> rays = raysAtEdges(mesh, centre, matrix);
    size_t leaks = 0;
    for (const shared::HitData& hit : caster.closest(rays)) leaks += hit.t < 0.0f ? 1u : 0u;
    return leaks;
}

TestMesh ball(uint32_t rings, const glm::vec3& centre) { return accel_test::sphere(2.0f, rings, 2 * rings, centre); }

/// Radius between 1.6 and 2.4 from vertex to vertex.
TestMesh bumpyBall(uint32_t rings) {
    TestMesh mesh = ball(rings, glm::vec3(0.0f));
    Random random(92);
    for (glm::vec3& p : mesh.positions) p *= random.uniform(0.8f, 1.2f);
    return mesh;
}

using Watertight = GpuTest;

TEST_F(Watertight, NoLeaksAtTheOrigin) {
    EXPECT_EQ(countLeaks(device_, ball(50, glm::vec3(0.0f)), glm::vec3(0.0f)), 0u);
    EXPECT_EQ(countLeaks(device_, ball(200, glm::vec3(0.0f)), glm::vec3(0.0f)), 0u);
}

TEST_F(Watertight, NoLeaksThroughBumps) {
    EXPECT_EQ(countLeaks(device_, bumpyBall(50), glm::vec3(0.0f)), 0u);
    EXPECT_EQ(countLeaks(device_, bumpyBall(200), glm::vec3(0.0f)), 0u);
}

TEST_F(Watertight, NoLeaksAwayFromTheOrigin) {
    const glm::vec3 centre(100.0f, 37.0f, -211.0f);
    EXPECT_EQ(countLeaks(device_, ball(50, centre), centre), 0u);
    EXPECT_EQ(countLeaks(device_, ball(200, centre), centre), 0u);
}

TEST_F(Watertight, NoLeaksOfATurnedInstance) {
    EXPECT_EQ(countLeaks(device_, ball(50, glm::vec3(0.0f)), glm::vec3(0.0f), true), 0u);
    EXPECT_EQ(countLeaks(device_, ball(200, glm::vec3(0.0f)), glm::vec3(0.0f), true), 0u);
}

/// Where a unit in the last place is 1/64, Embree allows itself 2e-5 in its robust mode.
TEST_F(Watertight, FewLeaksVeryFarFromTheOrigin) {
    const glm::vec3 centre(148376.0f, 1234.0f, -223423.0f);
    const auto allowed = static_cast<size_t>(2e-5 * static_cast<double>(kRays));
    EXPECT_LE(countLeaks(device_, ball(50, centre), centre), allowed);
    EXPECT_LE(countLeaks(device_, ball(200, centre), centre), allowed);
}

}  // namespace
}  // namespace raylab::support
