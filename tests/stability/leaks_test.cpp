#include <algorithm>
#include <array>
#include <cstdio>

#include "engine/render/ray_caster.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_rays.h"

/// S1: light leaks at shared edges. Rays from inside closed meshes, half of them at vertices and edges.
namespace raylab::support {
namespace {

using accel_test::TestMesh;

using Leaks = GpuTest;

/// Embree's own choice, where a unit in the last place is 1/64; it allows 2e-5 there in its robust mode.
const glm::vec3 kFarAway(148376.0f, 1234.0f, -223423.0f);
constexpr double kAllowedFarAway = 2e-5;

struct Closed {
    TestMesh mesh;
    glm::vec3 centre;
};

/// Closed meshes at the origin and, where there is a second one, far away.
std::vector<std::vector<Closed>> closedScenes() {
    return {{{ball(50, glm::vec3(0.0f)), glm::vec3(0.0f)}, {ball(200, kFarAway), kFarAway}},
            {{ball(200, glm::vec3(0.0f)), glm::vec3(0.0f)}, {ball(50, kFarAway), kFarAway}},
            {{bumpyBall(50), glm::vec3(0.0f)}}};
}

Scene sceneOf(const std::vector<Closed>& meshes) {
    Scene scene;
    const uint32_t material = addMaterial(scene, lambert(0.5f));
    for (const Closed& closed : meshes) addMesh(scene, meshOf(closed.mesh, material));
    return scene;
}

std::vector<shared::RayData> raysFor(const Closed& closed, size_t count) {
    std::vector<shared::RayData> rays = raysAtEdges(closed.mesh, closed.centre, count / 2);
    const std::vector<shared::RayData> others = raysFromInside(closed.centre, count - rays.size());
    rays.insert(rays.end(), others.begin(), others.end());
    return rays;
}

/// A part of `count` rays, by mesh.
std::vector<double> leakRates(Device& device, const std::vector<Closed>& meshes, const RenderSettings& settings,
                              size_t count) {
    RayCaster caster(device, sceneOf(meshes), settings);
    std::vector<double> rates;
    for (const Closed& closed : meshes) {
        const std::vector<shared::HitData> hits = caster.closest(raysFor(closed, count));
        const auto isLeak = [](const shared::HitData& hit) { return hit.t < 0.0f; };
        const auto leaks = std::count_if(hits.begin(), hits.end(), isLeak);
        rates.push_back(static_cast<double>(leaks) / static_cast<double>(count));
    }
    return rates;
}

void expectTight(const std::vector<double>& rates, const std::string& what) {
    EXPECT_EQ(rates[0], 0.0) << what;
    for (size_t i = 1; i < rates.size(); ++i) EXPECT_LE(rates[i], kAllowedFarAway) << what;
}

TEST_F(Leaks, DefaultIsTightInAMillionRays) {
    for (const std::vector<Closed>& meshes : closedScenes())
        expectTight(leakRates(device_, meshes, {}, 1'000'000), nameOf({}));
}

TEST_F(Leaks, WatertightIsTightInEveryLayout) {
    for (const std::vector<Closed>& meshes : closedScenes())
        for (const RenderSettings& settings : everyLayout())
            expectTight(leakRates(device_, meshes, settings, 100'000), nameOf(settings));
}

/// Tests that are known to leak: twice what was measured on lavapipe, 50 rings at the origin and 200 far away. Where
/// one stops to leak, its row is to be moved up.
struct KnownLeak {
    const char* triangle;
    double mostAtOrigin;
    double mostFarAway;
};
constexpr std::array kKnownLeaks = {KnownLeak{"minimal", 0.104, 0.0203}, KnownLeak{"precomputed", 0.0755, 0.0228},
                                    KnownLeak{"baldwin-weber", 0.105, 0.0157}};

TEST_F(Leaks, OtherTestsLeakAsMuchAsIsKnown) {
    const std::vector<Closed> meshes = closedScenes().front();
    std::printf("%-40s %10s %10s\n", "leaks per million rays", "at origin", "far away");
    for (const KnownLeak& known : kKnownLeaks)
        for (RenderSettings settings : everyLayout()) {
            settings.triangle = known.triangle;
            const std::vector<double> rates = leakRates(device_, meshes, settings, 100'000);
            std::printf("%-40s %10.0f %10.0f\n", nameOf(settings).c_str(), 1e6 * rates[0], 1e6 * rates[1]);
            EXPECT_GT(rates[0], 0.0) << nameOf(settings);
            EXPECT_LE(rates[0], known.mostAtOrigin) << nameOf(settings);
            EXPECT_GT(rates[1], 0.0) << nameOf(settings);
            EXPECT_LE(rates[1], known.mostFarAway) << nameOf(settings);
        }
}

}  // namespace
}  // namespace raylab::support
