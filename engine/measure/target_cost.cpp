#include "engine/measure/target_cost.h"

#include <algorithm>
#include <cmath>

namespace raylab {
namespace {

/// A flatter slope would say nothing of what is beyond the points.
constexpr double kFlattest = -0.1;

}  // namespace

std::optional<TargetCost> costOfError(const NoiseState& now, double relativeError, const Interval& slope) {
    if (!(now.relativeError > 0.0) || !(now.samples > 0.0) || !(relativeError > 0.0)) return std::nullopt;
    const double ratio = relativeError / now.relativeError;
    const auto factor = [&](double exponent) {
        const double used = std::isfinite(exponent) ? exponent : slope.value;
        return std::pow(ratio, 1.0 / std::min(used, kFlattest));
    };
    const auto [low, high] = std::minmax({factor(slope.low), factor(slope.high), factor(slope.value)});
    const Interval share{factor(slope.value), low, high};
    const auto times = [&](double unit) { return Interval{share.value * unit, share.low * unit, share.high * unit}; };
    return TargetCost{times(now.samples), times(now.seconds)};
}

std::optional<Interval> noiseSlopeOf(const ChartCurve& curve) {
    if (!curve.fit || curve.fit->degrees == 0 || curve.plateau != Plateau::none) return std::nullopt;
    const Interval slope = curve.fit->slopeInterval();
    if (!(slope.value < kFlattest)) return std::nullopt;
    return slope;
}

}  // namespace raylab
