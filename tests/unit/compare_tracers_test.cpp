#include "engine/measure/compare_tracers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/render/camera.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_rays.h"

namespace raylab::support {
namespace {

constexpr uint32_t kSize = 48;  // pixels

using CompareTracers = GpuTest;

BenchView viewOf(const Scene& scene, uint32_t size = kSize) {
    return {.camera = chooseCamera(scene, "0"), .light = defaultBenchLight(scene), .width = size, .height = size};
}

bool always(double) { return true; }

RenderSettings withTest(const char* triangle) {
    RenderSettings settings;
    settings.triangle = triangle;
    return settings;
}

/// A bumpy surface with a vertex on the ray of every pixel: each primary ray is aimed at an inner vertex, or at the
/// border.
Scene surfaceOfPixelVertices() {
    Scene scene;
    lookAt(scene, {0.3f, 0.7f, 2.9f}, {-0.1f, 0.05f, 0.2f}, 0.7f);
    shared::FrameParams frame{};
    writeCamera(scene.cameras[0], kSize, kSize, frame);
    accel_test::Random random(7);
    Mesh mesh;
    mesh.material = addMaterial(scene, lambert(0.5f));
    for (uint32_t y = 0; y < kSize; ++y)
        for (uint32_t x = 0; x < kSize; ++x) {
            const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) / static_cast<float>(kSize) * 2.0f - 1.0f;
            const glm::vec3 d = frame.cameraForward + ndc.x * frame.cameraRight - ndc.y * frame.cameraUp;
            mesh.positions.push_back(frame.cameraPosition + random.uniform(2.9f, 3.1f) * d);
            const uint32_t at = y * kSize + x;
            if (x + 1 == kSize || y + 1 == kSize) continue;
            mesh.triangles.emplace_back(at, at + 1, at + kSize);
            mesh.triangles.emplace_back(at + 1, at + kSize + 1, at + kSize);
        }
    addMesh(scene, mesh);
    return scene;
}

TEST_F(CompareTracers, ATracerDoesNotDifferFromItself) {
    const Scene scene = gridOfCubes();
    RayCaster a(device_, scene, {}), b(device_, scene, {});
    const RayComparison result = compareRays(a, b, scene, {.view = viewOf(scene), .rays = 20'000}, always);
    EXPECT_TRUE(result.complete);
    const DifferenceCounts total = result.total();
    EXPECT_EQ(total.rays, 20'000u);
    EXPECT_EQ(total.hitMiss + total.instance + total.primitive + total.tUlp1 + total.barycentrics + total.judged(), 0u);
    EXPECT_TRUE(result.offenders.empty());
    EXPECT_TRUE(result.heat.pixels.empty());
}

TEST_F(CompareTracers, EveryKindGetsItsShareSeedAfterSeed) {
    const Scene scene = gridOfCubes();
    RayCaster a(device_, scene, {}), b(device_, scene, bruteForce({}));
    const BenchView view = viewOf(scene, 16);
    uint64_t ofRound = 0;
    for (const RaySet& set : makeBenchRays(a, scene, view)) ofRound += set.rays.size();
    const RayComparison part = compareRays(a, b, scene, {.view = view, .rays = ofRound / 4}, always);
    EXPECT_EQ(part.total().rays, ofRound / 4);
    for (const KindCounts& kind : part.kinds) EXPECT_GT(kind.counts.rays, 0u) << kind.kind.name;
    const RayComparison more = compareRays(a, b, scene, {.view = view, .rays = 3 * ofRound + 1}, always);
    EXPECT_EQ(more.total().rays, 3 * ofRound + 1);
    EXPECT_GT(more.kinds[0].counts.rays, 2u * 16u * 16u);  // of the third seed
}

TEST_F(CompareTracers, LeakyTestsAreFoundWrongAndTheWatertightOneNever) {
    const Scene scene = surfaceOfPixelVertices();
    RayCaster watertight(device_, scene, {}), minimal(device_, scene, withTest("minimal"));
    const ComparePlan plan{.view = viewOf(scene), .rays = 3 * kSize * kSize, .offenders = 5, .heat = true};
    const RayComparison result = compareRays(watertight, minimal, scene, plan, always);
    const DifferenceCounts total = result.total();
    EXPECT_EQ(total.aWrong + total.bothWrong, 0u);
    EXPECT_GT(total.bWrong, kSize);  // measured on lavapipe: several per cent of 48 x 48
    EXPECT_GT(total.ties, 0u);       // another triangle at the same vertex
    EXPECT_EQ(total.judged(), total.hitMiss + total.instance + total.primitive + total.t);
    ASSERT_EQ(result.offenders.size(), 5u);
    for (const Offender& offender : result.offenders) {
        EXPECT_EQ(offender.state, RayState::bWrong);
        EXPECT_TRUE(offender.anyHit || offender.truth.hit());
        const std::vector<shared::RayData> ray = {offender.ray};
        const shared::HitData again = offender.anyHit ? minimal.occluded(ray)[0] : minimal.closest(ray)[0];
        EXPECT_EQ(again.t, offender.b.t) << "an offender can be traced again";
    }
    // The other way round it is A.
    const DifferenceCounts swapped = compareRays(minimal, watertight, scene, plan, always).total();
    EXPECT_EQ(swapped.bWrong + swapped.bothWrong, 0u);
    EXPECT_GT(swapped.aWrong, kSize);
}

TEST_F(CompareTracers, BruteForceAndSoftwareAgreeUpToTies) {
    for (const Scene& scene : {instancedSoup(), gridOfCubes()}) {
        RayCaster a(device_, scene, {}), b(device_, scene, bruteForce({}));
        const DifferenceCounts total =
            compareRays(a, b, scene, {.view = viewOf(scene), .rays = 20'000}, always).total();
        EXPECT_EQ(total.aWrong + total.bWrong + total.bothWrong, 0u);
    }
}

TEST_F(CompareTracers, TheMapShowsWhereAndWhat) {
    const Scene scene = surfaceOfPixelVertices();
    RayCaster a(device_, scene, {}), b(device_, scene, withTest("minimal"));
    const ComparePlan plan{.view = viewOf(scene), .rays = 1'000'000, .offenders = 100'000, .heat = true};
    // Stopped after the primary rays of the first seed, which are one batch.
    const RayComparison result = compareRays(a, b, scene, plan, [](double) { return false; });
    EXPECT_FALSE(result.complete);
    EXPECT_EQ(result.total().rays, kSize * kSize);
    ASSERT_EQ(result.heat.pixelCount(), kSize * kSize);
    const auto pixelsOf = [&](RayState state) {
        const std::array<float, 3>& rgb = kRayStates[static_cast<size_t>(state)].rgb;
        size_t pixels = 0;
        for (int y = 0; y < result.heat.height; ++y)
            for (int x = 0; x < result.heat.width; ++x)
                pixels += std::equal(rgb.begin(), rgb.end(), result.heat.at(x, y));
        return pixels;
    };
    EXPECT_EQ(pixelsOf(RayState::bWrong), result.total().bWrong);
    EXPECT_EQ(pixelsOf(RayState::tie), result.total().ties);
    EXPECT_EQ(pixelsOf(RayState::undecidable), result.total().undecidable);
    EXPECT_EQ(pixelsOf(RayState::aWrong), 0u);
    EXPECT_EQ(pixelsOf(RayState::notCompared), 0u);
}

}  // namespace
}  // namespace raylab::support
