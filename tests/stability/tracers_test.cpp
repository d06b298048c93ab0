#include <algorithm>
#include <cstdio>

#include "engine/measure/hit_oracle.h"
#include "engine/measure/stability/cases.h"
#include "engine/render/ray_caster.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

/// S1, S2, S7, S9, S11, S22 on the tracers over the driver's structures. They are not tight, and they break ties as the driver
/// likes: the numbers are bounded by what was measured on lavapipe (Mesa 25.0.7), and ours is held against the same rays.
namespace raylab::support {
namespace {

using accel_test::TestMesh;

class DriverTracers : public GpuTest {
protected:
    std::vector<RenderSettings> tracers() const {
        std::vector<RenderSettings> choices = hardwareTracers(device_.description());
        std::erase_if(choices, [](const RenderSettings& s) { return s.trees != "merged"; });
        return choices;
    }
};

size_t countMisses(Device& device, const Scene& scene, const RenderSettings& settings,
                   const std::vector<shared::RayData>& rays) {
    RayCaster caster(device, scene, settings);
    const std::vector<shared::HitData> hits = caster.closest(rays);
    return static_cast<size_t>(std::ranges::count_if(hits, [](const shared::HitData& hit) { return hit.t < 0.0f; }));
}

/// S1: a million rays from inside a ball at its vertices and edges. Measured: about 5,300 leaks.
TEST_F(DriverTracers, LeakAFewOfAMillionRaysAtEdges) {
    const TestMesh mesh = ball(50, glm::vec3(0.0f));
    const std::vector<shared::RayData> rays = raysAtEdges(mesh, glm::vec3(0.0f), 1'000'000);
    EXPECT_EQ(countMisses(device_, sceneOf(mesh), {}, rays), 0u);
    for (const RenderSettings& settings : tracers()) {
        const size_t leaks = countMisses(device_, sceneOf(mesh), settings, rays);
        std::printf("%-10s %zu of %zu rays at edges leak\n", settings.tracer.c_str(), leaks, rays.size());
        EXPECT_LE(leaks, rays.size() / 50) << settings.tracer;
    }
}

/// S2: a square cut at random into 20,000 triangles; 65,536 rays, as in the Khronos conformance tests.
TEST_F(DriverTracers, HitACutSquareOnce) {
    for (const RenderSettings& settings : tracers()) {
        const std::vector<stability::Number> numbers = stability::measureSingleHit({.device = device_, .settings = settings});
        std::printf("%-10s %g misses, %g double hits\n", settings.tracer.c_str(), numbers[0].value, numbers[1].value);
        EXPECT_EQ(numbers[0].value, 0.0) << settings.tracer;
        EXPECT_EQ(numbers[1].value, 0.0) << settings.tracer;
    }
}

/// S22: the same bits again, and by dispatches of 1 and 400 ms.
TEST_F(DriverTracers, RenderTheSameBitsAgain) {
    for (const RenderSettings& settings : tracers())
        for (const stability::Number& number :
             stability::measureDeterminism({.device = device_, .settings = settings, .quick = true}))
            EXPECT_TRUE(number.passes()) << settings.tracer << ": " << number.what << " " << number.value;
}

/// S22: ours and the driver's have the same means.
TEST_F(DriverTracers, AreAsBrightAsSoftware) {
    const stability::Context context{.device = device_, .settings = {}, .quick = true};
    for (const auto measure : {stability::measureAgainstQuery, stability::measureAgainstPipeline}) {
        try {
            const std::vector<stability::Number> numbers = measure(context);
            ASSERT_EQ(numbers.size(), 2u);
            std::printf("%s: %g; %s: %g\n", numbers[0].what.c_str(), numbers[0].value, numbers[1].what.c_str(),
                        numbers[1].value);
            EXPECT_TRUE(numbers[0].passes()) << numbers[0].what << " " << numbers[0].value;
        } catch (const stability::Skipped& skipped) {
            std::printf("not run: %s\n", skipped.what());
        }
    }
}

/// Rays that miss all edges.
TEST_F(DriverTracers, DoNotLeakWithinTriangles) {
    const TestMesh mesh = ball(50, glm::vec3(0.0f));
    const std::vector<shared::RayData> rays = raysFromInside(glm::vec3(0.0f), 200'000);
    for (const RenderSettings& settings : tracers())
        EXPECT_LE(countMisses(device_, sceneOf(mesh), settings, rays), 4u) << settings.tracer;
}

/// S7: along axes, from faces and edges of boxes.
TEST_F(DriverTracers, HitWhatRaysAlongAxesHit) {
    const Scene scene = gridOfCubes();
    const HitOracle oracle(scene);
    const std::vector<shared::RayData> rays = raysAlongAxes(20'000, 321);
    RayCaster software(device_, scene, {});
    const std::vector<shared::HitData> expected = software.closest(rays);
    for (const RenderSettings& settings : tracers()) {
        RayCaster caster(device_, scene, settings);
        const std::vector<shared::HitData> hits = caster.closest(rays);
        size_t wrong = 0, softwareWrong = 0;
        for (uint32_t i = 0; i < rays.size(); ++i) {
            if (isSameHit(hits[i], expected[i])) continue;
            const Verdict verdict = oracle.judgeClosest(rays[i], i, expected[i], hits[i]).verdict;
            wrong += verdict == Verdict::aRight || verdict == Verdict::neither ? 1u : 0u;
            softwareWrong += verdict == Verdict::bRight || verdict == Verdict::neither ? 1u : 0u;
        }
        std::printf("%-10s %zu of %zu rays along axes are wrong\n", settings.tracer.c_str(), wrong, rays.size());
        EXPECT_EQ(softwareWrong, 0u) << settings.tracer;
        EXPECT_LE(wrong, rays.size() / 20) << settings.tracer;
    }
}

/// S9: of 10,000 identical triangles the driver may show any, and all at the same distance.
TEST_F(DriverTracers, HitOneOfManyIdenticalTriangles) {
    TestMesh mesh;
    for (int i = 0; i < 10'000; ++i) mesh.add({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
    std::vector<shared::RayData> rays;
    for (int i = 0; i < 16; ++i) rays.push_back(makeRay({0.05f * float(i), 0.3f, 2.0f}, {0, 0, -1}));
    for (const RenderSettings& settings : tracers()) {
        RayCaster caster(device_, sceneOf(mesh), settings);
        for (const shared::HitData& hit : caster.closest(rays)) {
            EXPECT_NEAR(hit.t, 2.0f, 1e-6f) << settings.tracer;
            EXPECT_LT(hit.primitive, 10'000u) << settings.tracer;
        }
    }
}

/// S11: a matrix without an inverse shows nothing, and takes nothing else away.
TEST_F(DriverTracers, LeaveSingularInstancesOut) {
    Scene scene = soupScene(500, 0.2f);
    glm::mat4 flat(1.0f);
    flat[1] = glm::vec4(0.0f);
    addInstance(scene, 0, flat);
    RayCaster software(device_, scene, twoLevels({}));
    const std::vector<shared::RayData> rays = randomRays(scene, 2000, 322);
    const std::vector<shared::HitData> expected = software.closest(rays);
    for (RenderSettings settings : tracers()) {
        settings.trees = "mesh";
        RayCaster caster(device_, scene, settings);
        const std::vector<shared::HitData> hits = caster.closest(rays);
        size_t different = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            different += hits[i].primitive != expected[i].primitive || hits[i].instance != expected[i].instance ? 1u : 0u;
            EXPECT_TRUE(hits[i].t < 0.0f || hits[i].instance == 0u);
        }
        EXPECT_LE(different, 4u) << settings.tracer;
    }
}

}  // namespace
}  // namespace raylab::support
