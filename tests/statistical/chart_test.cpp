#include "engine/measure/chart_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/measure/chart_analysis.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

constexpr int64_t kSize = 16;
const glm::dvec3 kRho(0.25, 0.5, 0.75);

const auto kGoOn = [] { return false; };

/// A2: a closed box whose walls emit 1 and reflect rho.
Scene closedBox() {
    Scene scene;
    Material wall = lambert(glm::vec3(kRho));
    wall.emission = glm::vec3(1.0f);
    wall.doubleSided = true;
    addMesh(scene, box(addMaterial(scene, wall), {-1.0f, -1.5f, -2.0f}, glm::vec3(1.0f)));
    lookAt(scene, {0.2f, 0.1f, 0.3f}, {-1.0f, -0.5f, -2.0f}, 1.2f);
    return scene;
}

Reference constantReference(glm::dvec3 value) {
    Reference reference;
    reference.image.mean = Bitmap(kSize, kSize, 3);
    reference.image.varianceOfMean = Bitmap(kSize, kSize, 3);
    for (size_t i = 0; i < reference.image.mean.pixels.size(); ++i)
        reference.image.mean.pixels[i] = static_cast<float>(value[static_cast<int>(i % 3)]);
    return reference;
}

ChartPlan planOf(const std::vector<int64_t>& depths, int levels) {
    ChartPlan plan;
    for (const int64_t depth : depths)
        plan.configs.push_back({"depth=" + std::to_string(depth), smallImage(kSize, 1, depth)});
    plan.levels = levels;
    plan.firstSeed = 20261122;
    return plan;
}

std::vector<ChartCurve> curvesOf(const ChartPlan& plan, const ChartTable& table) {
    std::vector<std::string> names;
    for (const ChartConfig& config : plan.configs) names.push_back(config.name);
    return analyseChart(table, names, plan.measure, std::vector<double>(names.size(), 0.0));
}

ChartTable measureAll(Device& device, const Scene& scene, const ChartPlan& plan, const Reference& reference) {
    ChartRun run(device, scene, plan, std::vector(plan.configs.size(), &reference));
    while (run.next(kGoOn)) {
    }
    return run.table();
}

using ChartTest = GpuTest;

/// Depth 60 is off the limit by .75^61 = 2e-8 of it; depth 1 by rho^2 / (1 - rho), exactly.
TEST_F(ChartTest, FindsTheExactBiasOfADepthCapAndNoneWithout) {
    const ChartPlan plan = planOf({60, 1}, 7);
    const Reference reference = constantReference(1.0 / (1.0 - kRho));
    const ChartTable table = measureAll(device_, closedBox(), plan, reference);
    ASSERT_EQ(table.points.size(), 2u * 7u * 4u);
    const std::vector<ChartCurve> curves = curvesOf(plan, table);

    const glm::dvec3 limit = 1.0 / (1.0 - kRho), missing = kRho * kRho * limit;
    double exact = 0.0;
    for (int c = 0; c < 3; ++c) exact += missing[c] * missing[c] / (limit[c] * limit[c] + 1e-2) / 3.0;
    for (const ChartGroup& group : curves[0].groups)
        EXPECT_LE(std::abs(group.bias->biasSquared), 4.0 * group.bias->standardError) << group.samples;
    for (const ChartGroup& group : curves[1].groups)
        EXPECT_NEAR(group.bias->biasSquared, exact, 4.0 * group.bias->standardError) << group.samples;
    EXPECT_NEAR(curves[1].bias.value, std::sqrt(exact), 0.005 * std::sqrt(exact));
    EXPECT_EQ(curves[0].plateau, Plateau::none);
    EXPECT_EQ(curves[0].bias.low, 0.0);
    EXPECT_EQ(curves[1].plateau, Plateau::bias);
    // Well-distributed points do better than independent ones, never worse.
    EXPECT_LT(curves[0].fit->slopeInterval(0.999).low, -0.5);
    EXPECT_GT(curves[0].fit->slope, -1.0);
}

/// A1: where all is as bright as the sky, in any number of bounces.
TEST_F(ChartTest, AFurnaceHasNoBias) {
    Scene scene;
    scene.environment = constantEnvironment(1.0f);
    Mesh cup = box(addMaterial(scene, lambert(1.0f)), glm::vec3(-1.0f), glm::vec3(1.0f));
    cup.triangles.erase(cup.triangles.begin() + 6, cup.triangles.begin() + 8);  // no lid
    addMesh(scene, std::move(cup));
    lookAt(scene, {0.0f, 4.0f, 0.1f}, glm::vec3(0.0f, -1.0f, 0.0f), 0.3f);
    const ChartPlan plan = planOf({200}, 5);
    const ChartTable table = measureAll(device_, scene, plan, constantReference(glm::dvec3(1.0)));
    for (const ChartBias& bias : table.biases) {
        EXPECT_GT(bias.estimate.variance, 0.0);
        EXPECT_LE(std::abs(bias.estimate.biasSquared), 4.0 * bias.estimate.standardError) << bias.samples;
    }
    EXPECT_EQ(table.biases.size(), 5u);
}

/// Everything but the clock.
bool isSamePicture(const ChartPoint& a, const ChartPoint& b) {
    return a.config == b.config && a.seed == b.seed && a.samples == b.samples && a.rmse == b.rmse &&
           a.relMse == b.relMse && a.flip == b.flip;
}

TEST_F(ChartTest, ResumedPointsAreThoseOfOneRun) {
    const ChartPlan plan = planOf({0, 2}, 3);
    const Scene scene = closedBox();
    const Reference reference = constantReference(1.0 / (1.0 - kRho));
    const std::vector<const Reference*> references(2, &reference);
    const ChartTable whole = measureAll(device_, scene, plan, reference);

    ChartRun first(device_, scene, plan, references);
    for (int i = 0; i < 13; ++i) ASSERT_TRUE(first.next(kGoOn));
    ChartRun second(device_, scene, plan, references);
    second.resume(first.table(), first.partials());
    ASSERT_EQ(second.table().points.size(), 13u);
    while (second.next(kGoOn)) {
    }
    ASSERT_EQ(second.table().points.size(), whole.points.size());
    for (const ChartPoint& point : whole.points)
        EXPECT_EQ(
            std::ranges::count_if(second.table().points, [&](const ChartPoint& p) { return isSamePicture(p, point); }),
            1)
            << point.config << " " << point.seed;
    ASSERT_EQ(second.table().biases.size(), whole.biases.size());
    for (const ChartBias& bias : whole.biases) {
        const auto same = std::ranges::find_if(second.table().biases, [&](const ChartBias& b) {
            return b.config == bias.config && b.samples == bias.samples;
        });
        ASSERT_NE(same, second.table().biases.end());
        EXPECT_NEAR(same->estimate.biasSquared, bias.estimate.biasSquared, 1e-9);
    }

    ChartRun third(device_, scene, plan, references);
    third.resume(first.table(), {});  // without the sums of the level that was under way
    EXPECT_EQ(third.table().points.size(), 8u);
}

TEST_F(ChartTest, PointsShareNoRandomNumbersWithinAConfiguration) {
    const ChartPlan plan = planOf({0}, 6);
    std::set<uint32_t> seeds;
    for (int level = 0; level < plan.levels; ++level)
        for (int repeat = 0; repeat < plan.seeds; ++repeat) seeds.insert(seedOfPoint(plan, level, repeat));
    EXPECT_EQ(seeds.size(), 24u);
}

TEST_F(ChartTest, StopsWhenAsked) {
    const Reference reference = constantReference(1.0 / (1.0 - kRho));
    const Scene scene = closedBox();
    ChartRun run(device_, scene, planOf({1}, 2), {&reference});
    EXPECT_FALSE(run.next([] { return true; }));
    EXPECT_TRUE(run.table().points.empty());
}

}  // namespace
}  // namespace raylab::support
