#include "engine/measure/chart_analysis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <tuple>

namespace raylab {
namespace {

constexpr int kSeeds = 4;

/// Points of a method whose squared error is noise^2 / samples + bias^2, at a second a sample, with 3 % of spread.
void addMethod(ChartTable& table, const std::string& name, double noise, double bias, double secondsPerSample,
               std::mt19937& random, int levels = 8) {
    std::normal_distribution<double> spread(0.0, 0.03);
    for (int level = 0; level < levels; ++level) {
        const double samples = std::pow(2.0, level);
        for (int seed = 0; seed < kSeeds; ++seed) {
            const double error = std::sqrt(noise * noise / samples + bias * bias) * std::exp(spread(random));
            table.points.push_back({name, static_cast<uint32_t>(level * kSeeds + seed), static_cast<uint32_t>(samples),
                                    samples * secondsPerSample, samples * secondsPerSample, error, error * error,
                                    error});
        }
        const double error = 0.1 * noise * noise / samples;
        table.biases.push_back(
            {name, static_cast<uint32_t>(samples), {bias * bias + 0.5 * error, error, noise * noise / samples}});
    }
}

TEST(ChartAnalysis, NoiseHasSlopeHalfAndBiasIsAPlateau) {
    std::mt19937 random(11);
    ChartTable table;
    addMethod(table, "noise", 1.0, 0.0, 1.0, random);
    addMethod(table, "bias", 1.0, 0.3, 1.0, random, 12);
    const std::vector<ChartCurve> curves = analyseChart(table, {"noise", "bias"}, ErrorMeasure::rmse, {0.0, 0.0});
    ASSERT_TRUE(curves[0].fit && curves[0].tail);
    const Interval slope = curves[0].fit->slopeInterval(0.999);
    EXPECT_TRUE(slope.low <= -0.5 && -0.5 <= slope.high) << slope.value;
    EXPECT_EQ(curves[0].plateau, Plateau::none);
    EXPECT_EQ(curves[0].bias.low, 0.0);
    EXPECT_EQ(curves[1].plateau, Plateau::bias);
    EXPECT_NEAR(curves[1].bias.value, 0.3, 0.01);
    EXPECT_TRUE(curves[1].bias.low <= 0.3 && 0.3 <= curves[1].bias.high);
}

TEST(ChartAnalysis, ANoisyReferenceIsNotCalledBias) {
    std::mt19937 random(12);
    ChartTable table;
    addMethod(table, "a", 1.0, 0.3, 1.0, random, 12);
    for (ChartBias& bias : table.biases) bias.estimate.biasSquared = 0.0;
    EXPECT_EQ(analyseChart(table, {"a"}, ErrorMeasure::rmse, {0.09})[0].plateau, Plateau::referenceNoise);
    EXPECT_EQ(analyseChart(table, {"a"}, ErrorMeasure::rmse, {0.0})[0].plateau, Plateau::unexplained);
}

TEST(ChartAnalysis, GroupsHaveMediansAndStudentsIntervals) {
    ChartTable table;
    for (const double error : {1.0, 2.0, 4.0})
        table.points.push_back({"a", 0, 1, error * 10.0, error * 20.0, error, error * error, 0.0});
    const ChartGroup group = analyseChart(table, {"a"}, ErrorMeasure::rmse, {0.0})[0].groups.at(0);
    EXPECT_EQ(group.seeds, 3u);
    EXPECT_NEAR(group.error.value, 2.0, 1e-12);
    EXPECT_EQ(group.medianError, 2.0);
    EXPECT_EQ(group.deviceSeconds.value, 20.0);
    // ln 2 is the deviation of the logarithms; t(.975, 2) = 4.303.
    EXPECT_NEAR(group.error.high, 2.0 * std::exp(4.303 * std::log(2.0) / std::sqrt(3.0)), 0.01);
    EXPECT_NEAR(group.error.low * group.error.high, 4.0, 1e-9);
}

/// The definition, by brute force over a cloud of groups.
TEST(ChartAnalysis, TheParetoFrontIsWhatNothingBeats) {
    std::mt19937 random(13);
    std::uniform_real_distribution<double> uniform(0.1, 1.0);
    std::vector<ChartCurve> curves(5);
    for (ChartCurve& curve : curves)
        for (int i = 0; i < 20; ++i) {
            ChartGroup group;
            group.deviceSeconds = {uniform(random), 0.0, 0.0};
            group.error = {uniform(random), 0.0, 0.0};
            group.deviceSeconds.low = group.deviceSeconds.value * 0.9;
            group.deviceSeconds.high = group.deviceSeconds.value * 1.1;
            group.error.low = group.error.value * 0.8;
            group.error.high = group.error.value * 1.2;
            curve.groups.push_back(group);
        }
    markPareto(curves);
    size_t front = 0, possible = 0;
    for (const ChartCurve& curve : curves)
        for (const ChartGroup& group : curve.groups) {
            bool isBeaten = false, isSurelyBeaten = false;
            for (const ChartCurve& other : curves)
                for (const ChartGroup& g : other.groups) {
                    isBeaten |= g.deviceSeconds.value < group.deviceSeconds.value && g.error.value < group.error.value;
                    isSurelyBeaten |= g.deviceSeconds.high < group.deviceSeconds.low && g.error.high < group.error.low;
                }
            EXPECT_EQ(group.pareto, !isBeaten);
            EXPECT_EQ(group.paretoPossible, !isSurelyBeaten);
            front += group.pareto ? 1 : 0;
            possible += group.paretoPossible ? 1 : 0;
        }
    EXPECT_GT(front, 1u);
    EXPECT_GT(possible, front);
    EXPECT_LT(possible, 100u);
}

/// Two triangle tests trace the same paths: a billionth less error is not worth a fifth more time.
TEST(ChartAnalysis, RoundingIsNoPlaceOnTheParetoFront) {
    std::vector<ChartCurve> curves(2);
    for (const auto& [curve, seconds, error] : {std::tuple{0, 1.0, 0.1}, std::tuple{1, 1.2, 0.1 * (1.0 - 1e-9)}}) {
        ChartGroup group;
        group.deviceSeconds = {seconds, seconds, seconds};
        group.error = {error, error, error};
        curves[static_cast<size_t>(curve)].groups.push_back(group);
    }
    markPareto(curves);
    EXPECT_TRUE(curves[0].groups[0].pareto);
    EXPECT_FALSE(curves[1].groups[0].pareto);
}

ChartCurve exactCurve() {
    ChartCurve curve;
    for (const double samples : {1.0, 4.0, 16.0}) {
        ChartGroup group;
        group.samples = static_cast<uint32_t>(samples);
        group.deviceSeconds = {samples, samples, samples};
        const double error = 1.0 / std::sqrt(samples);
        group.error = {error, error / 1.1, error * 1.1};
        curve.groups.push_back(group);
    }
    return curve;
}

TEST(ChartAnalysis, InterpolationFollowsAPowerLaw) {
    const ChartCurve curve = exactCurve();
    const std::optional<Interval> error = errorAtTime(curve, 9.0);
    ASSERT_TRUE(error);
    EXPECT_NEAR(error->value, 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(error->high, 1.1 / 3.0, 1e-12);
    const std::optional<Interval> time = timeToError(curve, 1.0 / 3.0);
    ASSERT_TRUE(time);
    EXPECT_NEAR(time->value, 9.0, 1e-9);
    EXPECT_NEAR(time->low, 9.0 / 1.21, 1e-9);
    EXPECT_NEAR(time->high, 9.0 * 1.21, 1e-9);
    EXPECT_FALSE(errorAtTime(curve, 0.5));
    EXPECT_FALSE(errorAtTime(curve, 17.0));
    EXPECT_FALSE(timeToError(curve, 0.2));
    EXPECT_FALSE(timeToError(curve, 2.0));
    EXPECT_TRUE(std::isinf(timeToError(curve, 0.26)->high));
}

TEST(ChartAnalysis, TheBestNamesThoseThatMayBeAsGood) {
    const auto best = bestOf({Interval{2.0, 1.5, 2.5}, Interval{1.0, 0.8, 1.6}, std::nullopt, Interval{3.0, 2.0, 4.0}});
    ASSERT_TRUE(best);
    EXPECT_EQ(best->curve, 1u);
    EXPECT_EQ(best->ties, std::vector<size_t>{0});
    EXPECT_FALSE(bestOf({std::nullopt}));
}

TEST(ChartAnalysis, TablesAreAtRoundValuesWithinWhatWasMeasured) {
    const std::vector<ChartCurve> curves = {exactCurve()};
    const std::vector<double> times = tableTimes(curves), errors = tableErrors(curves);
    ASSERT_EQ(times.size(), 4u);
    for (size_t i = 0; i < 4; ++i) EXPECT_NEAR(times[i], std::vector<double>({1, 2, 5, 10})[i], 1e-12);
    ASSERT_EQ(errors.size(), 1u);  // 1 is where the curve begins
    EXPECT_NEAR(errors[0], 0.5, 1e-12);
}

}  // namespace
}  // namespace raylab
