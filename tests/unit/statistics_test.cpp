#include "engine/measure/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace raylab {
namespace {

struct QuantileRow {
    size_t degrees;
    double t95, t99;  ///< two-sided
};

/// Abramowitz and Stegun 1964, table 26.10 (two-sided probabilities .95 and .99).
constexpr QuantileRow kPublished[] = {{1, 12.706, 63.657}, {2, 4.303, 9.925},  {3, 3.182, 5.841},  {4, 2.776, 4.604},
                                      {5, 2.571, 4.032},   {10, 2.228, 3.169}, {15, 2.131, 2.947}, {29, 2.045, 2.756},
                                      {30, 2.042, 2.750},  {120, 1.980, 2.617}};

TEST(Statistics, StudentQuantilesAreThePublishedOnes) {
    for (const QuantileRow& row : kPublished) {
        EXPECT_NEAR(studentQuantile(0.95, row.degrees), row.t95, 5e-4 * row.t95) << row.degrees;
        EXPECT_NEAR(studentQuantile(0.99, row.degrees), row.t99, 5e-4 * row.t99) << row.degrees;
    }
    EXPECT_NEAR(studentQuantile(0.95, 100000), 1.95996, 1e-4);  // the normal distribution's
}

TEST(Statistics, MedianIsTheMiddle) {
    EXPECT_EQ(medianOf(std::vector<double>{3.0, 1.0, 2.0}), 2.0);
    EXPECT_EQ(medianOf(std::vector<double>{4.0, 1.0, 2.0, 8.0}), 3.0);
    EXPECT_TRUE(std::isnan(medianOf({})));
}

TEST(Statistics, IntervalsOfOneValueAreUnknown) {
    const Interval one = meanInterval(std::vector<double>{5.0});
    EXPECT_EQ(one.value, 5.0);
    EXPECT_TRUE(std::isnan(one.low) && std::isnan(one.high));
}

/// How often an interval contains the truth, over simulations; the standard error of that share is .0034 at .95 and
/// 4000.
constexpr int kSimulations = 4000;
constexpr double kCoverageTolerance = 0.015;

TEST(Statistics, MeanIntervalsContainTheTruthAsOftenAsTheySay) {
    std::mt19937 random(20261122);
    std::normal_distribution<double> normal(3.0, 2.0);
    int contained = 0, containedGeometric = 0;
    for (int i = 0; i < kSimulations; ++i) {
        std::vector<double> values(4), factors;
        for (double& value : values) value = normal(random);
        for (const double value : values) factors.push_back(std::exp(value));
        const Interval mean = meanInterval(values);
        contained += mean.low <= 3.0 && 3.0 <= mean.high ? 1 : 0;
        const Interval geometric = geometricInterval(factors);
        containedGeometric += geometric.low <= std::exp(3.0) && std::exp(3.0) <= geometric.high ? 1 : 0;
    }
    EXPECT_NEAR(contained / double{kSimulations}, 0.95, kCoverageTolerance);
    EXPECT_NEAR(containedGeometric / double{kSimulations}, 0.95, kCoverageTolerance);
}

TEST(Statistics, LineThroughExactValuesIsThatLine) {
    const LineFit fit = fitLine(std::vector<double>{0.0, 1.0, 2.0, 5.0}, std::vector<double>{1.0, 0.5, 0.0, -1.5});
    EXPECT_NEAR(fit.intercept, 1.0, 1e-12);
    EXPECT_NEAR(fit.slope, -0.5, 1e-12);
    EXPECT_NEAR(fit.slopeError, 0.0, 1e-12);
    EXPECT_EQ(fit.degrees, 2u);
    const LineFit two = fitLine(std::vector<double>{0.0, 1.0}, std::vector<double>{0.0, 2.0});
    EXPECT_EQ(two.slope, 2.0);
    EXPECT_TRUE(std::isnan(two.slopeInterval().low));
}

/// A chart's own case: errors over 1, 2, 4, ... 64 samples of 4 seeds each, with a slope of -1/2 and noise of 10 %.
TEST(Statistics, SlopeIntervalsContainTheSlopeAsOftenAsTheySay) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 0.1);
    int contained = 0;
    double sum = 0.0;
    for (int i = 0; i < kSimulations; ++i) {
        std::vector<double> x, y;
        for (int level = 0; level < 7; ++level)
            for (int seed = 0; seed < 4; ++seed) {
                x.push_back(level * std::log(2.0));
                y.push_back(std::log(0.3) - 0.5 * x.back() + noise(random));
            }
        const Interval slope = fitLine(x, y).slopeInterval();
        contained += slope.low <= -0.5 && -0.5 <= slope.high ? 1 : 0;
        sum += slope.value;
    }
    EXPECT_NEAR(contained / double{kSimulations}, 0.95, kCoverageTolerance);
    EXPECT_NEAR(sum / kSimulations, -0.5, 1e-3);
}

}  // namespace
}  // namespace raylab
