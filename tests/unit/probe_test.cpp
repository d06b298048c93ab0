#include "engine/measure/probe.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raylab {
namespace {

/// Two seeds of 16 samples at .5 s a sample, squared errors .04 and .06, after a build of 2 s.
Probe someProbe(double biasSquared) {
    Probe probe;
    probe.samples = 16;
    probe.sampleSeconds = {0.5, 0.5};
    probe.squaredErrors = {0.04, 0.06};
    probe.bias = {biasSquared, 0.001, 0.05};
    probe.buildSeconds = 2.0;
    return probe;
}

TEST(Probe, NoiseFallsWithSamples) {
    const Probe probe = someProbe(0.0);
    EXPECT_NEAR(probe.sampleVariance(), 0.8, 1e-12);
    EXPECT_NEAR(probe.secondsToError(0.1, 0), 2.0 + 0.64 / 0.01 * 0.5, 1e-9);
    EXPECT_NEAR(probe.secondsToError(0.1, 1), 2.0 + 0.96 / 0.01 * 0.5, 1e-9);
    EXPECT_NEAR(probe.errorAfter(40.0), 0.1, 1e-12);
    EXPECT_NEAR(probe.secondsToError(10.0, 0), 2.5, 1e-12);  // one sample is the least
}

TEST(Probe, BiasLeavesLessRoomForNoise) {
    const Probe probe = someProbe(0.02);
    EXPECT_NEAR(probe.secondsToError(0.2, 0), 2.0 + 0.02 * 16 / 0.02 * 0.5, 1e-9);
    EXPECT_TRUE(std::isinf(probe.secondsToError(0.145, 0)));
    EXPECT_NEAR(probe.errorAfter(1e9), std::sqrt(0.02), 1e-6);
    EXPECT_EQ(someProbe(0.0019).biasSquared(), 0.0);  // chance would explain it
}

}  // namespace
}  // namespace raylab
