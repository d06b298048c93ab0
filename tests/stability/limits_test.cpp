#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

/// S24: nothing at all, and more than fits into one storage buffer of lavapipe (128 MiB).
namespace raylab::support {
namespace {

using accel_test::Random;

using Limits = GpuTest;

TEST_F(Limits, EmptySceneIsMissed) {
    Scene scene;
    addMaterial(scene, lambert(0.5f));
    std::vector<shared::RayData> rays;
    Random random(131);
    for (int i = 0; i < 100; ++i) rays.push_back(makeRay(random.inCube(-1.0f, 1.0f), random.direction()));
    std::vector<RenderSettings> choices = everyLayout();
    choices.push_back(bruteForce({}));
    for (const RenderSettings& settings : choices) {
        RayCaster caster(device_, scene, settings);
        for (const shared::HitData& hit : caster.closest(rays)) EXPECT_LT(hit.t, 0.0f) << nameOf(settings);
        for (const shared::HitData& hit : caster.occluded(rays)) EXPECT_LT(hit.t, 0.0f) << nameOf(settings);
    }
}

/// Unit cells in the plane y = 0, two triangles each: what a ray from above hits follows from where it goes.
Mesh unitGrid(uint32_t cells) {
    Mesh mesh;
    for (uint32_t z = 0; z <= cells; ++z)
        for (uint32_t x = 0; x <= cells; ++x) mesh.positions.emplace_back(x, 0.0f, z);
    for (uint32_t z = 0; z < cells; ++z)
        for (uint32_t x = 0; x < cells; ++x) {
            const uint32_t a = z * (cells + 1) + x, b = a + cells + 1;
            mesh.triangles.emplace_back(a, a + 1, b);
            mesh.triangles.emplace_back(a + 1, b + 1, b);
        }
    return mesh;
}

TEST_F(Limits, MoreTrianglesThanAStorageBufferHolds) {
    constexpr uint32_t kCells = 1210;
    Scene scene;
    addMaterial(scene, lambert(0.5f));
    addMesh(scene, unitGrid(kCells));
    ASSERT_GT(scene.meshes[0].triangles.size() * sizeof(shared::TraceTriangle), size_t{128} << 20);
    Random random(132);
    std::vector<shared::RayData> rays;
    std::vector<uint32_t> expected;
    for (int i = 0; i < 10'000; ++i) {
        const glm::uvec2 cell(random.below(kCells), random.below(kCells));
        const bool second = i % 2 == 1;
        const glm::vec2 inside = second ? glm::vec2(0.75f, 0.625f) : glm::vec2(0.25f, 0.125f);
        rays.push_back(
            makeRay({static_cast<float>(cell.x) + inside.x, 1.0f, static_cast<float>(cell.y) + inside.y}, {0, -1, 0}));
        expected.push_back(2 * (cell.y * kCells + cell.x) + (second ? 1u : 0u));
    }
    for (const char* layout : {"bvh4b", "bvh8q"}) {
        RenderSettings settings;
        settings.layout = layout;
        RayCaster caster(device_, scene, settings);
        const std::vector<shared::HitData> hits = caster.closest(rays);
        size_t wrong = 0;
        for (size_t i = 0; i < hits.size(); ++i)
            wrong += hits[i].t == 1.0f && hits[i].primitive == expected[i] ? 0u : 1u;
        EXPECT_EQ(wrong, 0u) << layout;
    }
}

}  // namespace
}  // namespace raylab::support
