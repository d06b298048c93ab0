#pragma once

#include <optional>

#include "engine/measure/chart_analysis.h"

namespace raylab {

/// A rendering that goes on: what it has come to.
struct NoiseState {
    double relativeError = 0.0;  ///< estimated from its own variance: noise alone
    double samples = 0.0;        ///< a pixel
    double seconds = 0.0;
};

/// What an error will cost, in all; ends by those of the slope.
struct TargetCost {
    Interval samples;
    Interval seconds;
};

/// The slope of error over samples for independent samples, with which noise falls at least.
constexpr Interval kNoiseSlope{-0.5, -0.5, -0.5};

/// error(n) = error(now) (n / n(now))^slope, solved for n. `slope`: of log error over log samples, all below 0; an end
/// that is not finite is taken for the value. Nothing where there is no noise to go by.
std::optional<TargetCost> costOfError(const NoiseState& now, double relativeError, const Interval& slope = kNoiseSlope);

/// The slope of noise that a curve tells: that of its fit, where that has an error and the curve is none that bias
/// flattens. Nothing else.
std::optional<Interval> noiseSlopeOf(const ChartCurve& curve);

}  // namespace raylab
