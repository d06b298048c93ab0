#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/render/ray_caster.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_rays.h"

/// S2: a square that is cut at random into triangles, as in the Khronos conformance tests: each ray must hit one of
/// them, and one only.
namespace raylab::support {
namespace {

using accel_test::Random;
using accel_test::TestMesh;

using SingleHit = GpuTest;

double doubleArea(const TestMesh& mesh, const glm::uvec3& t) {
    const glm::dvec2 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The square -1 .. 1 at z = 0, its triangles cut again and again by a point inside, often close to a corner.
TestMesh cutSquare(size_t count) {
    Random random(101);
    TestMesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    for (size_t at = 0; mesh.triangles.size() < count; at = (at + 1) % mesh.triangles.size()) {
        glm::uvec3& whole = mesh.triangles[at];
        const float small = std::pow(10.0f, random.uniform(-3.0f, -0.3f));
        const float part = random.uniform(0.1f, 0.9f);
        const auto corner = static_cast<int>(random.below(3));
        const glm::vec3 a = mesh.positions[whole[corner]];
        const glm::vec3 b = mesh.positions[whole[(corner + 1) % 3]], c = mesh.positions[whole[(corner + 2) % 3]];
        mesh.positions.push_back(a + small * (part * (b - a) + (1.0f - part) * (c - a)));
        const auto added = static_cast<uint32_t>(mesh.positions.size() - 1);
        const glm::uvec3 parts[] = {{whole.x, whole.y, added}, {whole.y, whole.z, added}, {whole.z, whole.x, added}};
        if (std::all_of(std::begin(parts), std::end(parts),
                        [&](const glm::uvec3& t) { return doubleArea(mesh, t) > 0.0; })) {
            whole = parts[0];  // before the reference goes
            mesh.triangles.insert(mesh.triangles.end(), {parts[1], parts[2]});
        } else {
            mesh.positions.pop_back();
        }
    }
    return mesh;
}

float shortestEdge(const TestMesh& mesh) {
    float shortest = 1e30f;
    for (const glm::uvec3& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            shortest = std::min(shortest, glm::distance(mesh.positions[t[i]], mesh.positions[t[(i + 1) % 3]]));
    return shortest;
}

std::vector<shared::RayData> raysThroughSquare(size_t count) {
    Random random(102);
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 origin(random.uniform(-3.0f, 3.0f), random.uniform(-3.0f, 3.0f), random.uniform(0.5f, 3.0f));
        const glm::vec3 target(random.uniform(-0.99f, 0.99f), random.uniform(-0.99f, 0.99f), 0.0f);
        rays.push_back(makeRay(origin, target - origin));
    }
    return rays;
}

struct Wrong {
    size_t misses = 0;
    size_t doubles = 0;
};

/// A second hit is behind the first or, where it is exactly as far, found first when ids count down.
Wrong countWrong(Device& device, const TestMesh& mesh, const RenderSettings& settings,
                 std::vector<shared::RayData> rays) {
    TestMesh reversed = mesh;
    std::reverse(reversed.triangles.begin(), reversed.triangles.end());
    RayCaster caster(device, sceneOf(mesh), settings), reversedCaster(device, sceneOf(reversed), settings);
    const std::vector<shared::HitData> first = caster.closest(rays), other = reversedCaster.closest(rays);
    for (size_t i = 0; i < rays.size(); ++i) rays[i].tMin = std::max(first[i].t, 0.0f);
    const std::vector<shared::HitData> behind = caster.occluded(rays);
    Wrong wrong;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (first[i].t < 0.0f)
            ++wrong.misses;
        else if (behind[i].t >= 0.0f || first[i].primitive + other[i].primitive + 1 != mesh.triangles.size())
            ++wrong.doubles;
    }
    return wrong;
}

TEST_F(SingleHit, EachRayThroughACutSquare) {
    const TestMesh mesh = cutSquare(20000);
    EXPECT_LE(shortestEdge(mesh), 1.5e-6f);
    const std::vector<shared::RayData> rays = raysThroughSquare(65536);
    for (const RenderSettings& settings : everyLayout()) {
        const Wrong wrong = countWrong(device_, mesh, settings, rays);
        EXPECT_EQ(wrong.misses, 0u) << nameOf(settings);
        EXPECT_EQ(wrong.doubles, 0u) << nameOf(settings);
    }
}

/// The other triangle tests are not tight; measured on lavapipe: 2 misses and 1 double hit at most.
TEST_F(SingleHit, OtherTestsAreWrongAsOftenAsIsKnown) {
    const TestMesh mesh = cutSquare(20000);
    const std::vector<shared::RayData> rays = raysThroughSquare(65536);
    for (const char* triangle : {"minimal", "precomputed", "baldwin-weber"}) {
        RenderSettings settings;
        settings.triangle = triangle;
        const Wrong wrong = countWrong(device_, mesh, settings, rays);
        std::printf("%-20s misses %3zu doubles %3zu of %zu\n", triangle, wrong.misses, wrong.doubles, rays.size());
        EXPECT_LE(wrong.misses, 4u) << triangle;
        EXPECT_LE(wrong.doubles, 2u) << triangle;
    }
}

}  // namespace
}  // namespace raylab::support
