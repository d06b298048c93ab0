#include "engine/measure/target_cost.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace raylab {
namespace {

TEST(TargetCost, IndependentNoiseNeedsFourTimesTheSamplesForHalfTheError) {
    const auto cost = costOfError({.relativeError = 0.1, .samples = 16.0, .seconds = 2.0}, 0.05);
    ASSERT_TRUE(cost);
    EXPECT_NEAR(cost->samples.value, 64.0, 1e-9);
    EXPECT_NEAR(cost->seconds.value, 8.0, 1e-9);
    EXPECT_NEAR(cost->samples.low, 64.0, 1e-9);
    EXPECT_NEAR(cost->samples.high, 64.0, 1e-9);
}

TEST(TargetCost, ASteeperSlopeCostsLessAndItsIntervalHoldsTheCost) {
    const NoiseState now{.relativeError = 0.2, .samples = 8.0, .seconds = 1.0};
    const auto cost = costOfError(now, 0.02, {-0.8, -1.0, -0.5});
    ASSERT_TRUE(cost);
    // error = .2 (n / 8)^-.8 at n gives .02 back.
    EXPECT_NEAR(0.2 * std::pow(cost->samples.value / 8.0, -0.8), 0.02, 1e-12);
    EXPECT_NEAR(cost->samples.low, 80.0, 1e-9);    // slope -1: ten times the samples
    EXPECT_NEAR(cost->samples.high, 800.0, 1e-9);  // slope -1/2: a hundred times
    EXPECT_NEAR(cost->seconds.value, cost->samples.value / 8.0, 1e-12);
}

TEST(TargetCost, SaysNothingWithoutNoise) {
    EXPECT_FALSE(costOfError({}, 0.05));
    EXPECT_FALSE(costOfError({.relativeError = -1.0, .samples = 4.0, .seconds = 1.0}, 0.05));
}

ChartCurve curveOf(double bias) {
    ChartCurve curve;
    std::vector<double> x, y;
    for (int level = 0; level < 8; ++level) {
        const double samples = std::exp2(level), wobble = level % 2 == 0 ? 1.01 : 0.99;
        x.push_back(std::log(samples));
        y.push_back(std::log(wobble * std::pow(samples, -0.6) + bias));
    }
    curve.fit = fitLine(x, y);
    return curve;
}

TEST(TargetCost, TakesTheSlopeOfAChartsCurveUnlessItIsFlat) {
    const auto slope = noiseSlopeOf(curveOf(0.0));
    ASSERT_TRUE(slope);
    EXPECT_LE(slope->low, -0.6);
    EXPECT_GE(slope->high, -0.6);
    EXPECT_FALSE(noiseSlopeOf(curveOf(100.0))) << "nothing falls";
    ChartCurve biased = curveOf(0.0);
    biased.plateau = Plateau::bias;
    EXPECT_FALSE(noiseSlopeOf(biased));
    EXPECT_FALSE(noiseSlopeOf(ChartCurve{}));
}

}  // namespace
}  // namespace raylab
