#include "engine/measure/cost_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/core/error.h"

namespace raylab {
namespace {

constexpr double kConstant = 40.0, kNode = 12.0, kTriangle = 30.0;

/// Counters as of rays of many kinds, times by the law above and noise in proportion to them.
std::vector<CostSample> samplesOfLaw(size_t count, double noise, uint32_t seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> nodes(5.0, 40.0), share(0.05, 0.6);
    std::normal_distribution<double> error(0.0, noise);
    std::vector<CostSample> samples;
    for (size_t i = 0; i < count; ++i) {
        CostSample sample{0.0, nodes(engine), 0.0};
        sample.triangles = share(engine) * sample.nodes;
        const double exact = kConstant + kNode * sample.nodes + kTriangle * sample.triangles;
        sample.nsPerRay = exact * (1.0 + error(engine));
        samples.push_back(sample);
    }
    return samples;
}

TEST(CostFit, FindsALawWithoutNoise) {
    const CostFit fit = fitCosts(samplesOfLaw(12, 0.0, 1));
    EXPECT_NEAR(fit.constant.value, kConstant, 1e-8);
    EXPECT_NEAR(fit.node.value, kNode, 1e-9);
    EXPECT_NEAR(fit.triangle.value, kTriangle, 1e-8);
    EXPECT_NEAR(fit.ratio.value, kTriangle / kNode, 1e-9);
    EXPECT_LT(fit.relativeResidual, 1e-10);
    EXPECT_EQ(fit.samples, 12u);
}

/// Over many draws of the noise the deviations from the law, in standard errors, have a mean square of 1 (of Student's
/// t with 33 degrees of freedom: 33 / 31), and the residual is the noise.
TEST(CostFit, StandardErrorsAreThoseOfTheNoise) {
    constexpr int kDraws = 2000;
    constexpr size_t kSamples = 36;
    constexpr double kNoise = 0.03, kDegrees = kSamples - 3.0;
    double node = 0.0, triangle = 0.0, ratio = 0.0, residual = 0.0;
    const auto squared = [](const Estimate& estimate, double exact) {
        const double deviation = (estimate.value - exact) / estimate.standardError;
        return deviation * deviation / kDraws;
    };
    for (uint32_t draw = 0; draw < kDraws; ++draw) {
        const CostFit fit = fitCosts(samplesOfLaw(kSamples, kNoise, 100 + draw));
        node += squared(fit.node, kNode);
        triangle += squared(fit.triangle, kTriangle);
        ratio += squared(fit.ratio, kTriangle / kNode);
        residual += fit.relativeResidual * fit.relativeResidual / kDraws;
    }
    // The mean of 2000 squares of standard deviation sqrt(2) and a bit: 4 standard errors are .14.
    const double expected = kDegrees / (kDegrees - 2.0);
    EXPECT_NEAR(node, expected, 0.14);
    EXPECT_NEAR(triangle, expected, 0.14);
    EXPECT_NEAR(ratio, expected, 0.16) << "to first order";
    EXPECT_NEAR(std::sqrt(residual), kNoise * std::sqrt(kDegrees / kSamples), 0.02 * kNoise);
}

TEST(CostFit, RefusesWhatTellsNothing) {
    EXPECT_THROW(fitCosts(samplesOfLaw(3, 0.01, 1)), Error);
    std::vector<CostSample> alike = samplesOfLaw(12, 0.01, 1);
    for (CostSample& sample : alike) sample.triangles = 0.25 * sample.nodes;
    EXPECT_THROW(fitCosts(alike), Error) << "triangles in proportion to nodes";
    for (CostSample& sample : alike) sample.triangles = 0.0;
    EXPECT_THROW(fitCosts(alike), Error) << "no triangles at all";
}

}  // namespace
}  // namespace raylab
