#include "engine/measure/chart_analysis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace raylab {
namespace {

/// A plateau of which the reference's noise is so much of the mean square is that noise.
constexpr double kReferenceShare = 0.25;
constexpr size_t kFewestTailGroups = 3;

/// Interval of the geometric mean, around the median: one run that was disturbed moves it little.
Interval timeInterval(const std::vector<double>& seconds) {
    Interval interval = geometricInterval(seconds);
    interval.value = medianOf(seconds);
    return interval;
}

ChartGroup makeGroup(const ChartTable& table, const std::string& config, uint32_t samples, ErrorMeasure measure) {
    std::vector<double> errors, device, wall;
    for (const ChartPoint& p : table.points) {
        if (p.samples != samples || p.config != config) continue;
        errors.push_back(p.error(measure));
        device.push_back(p.deviceSeconds);
        wall.push_back(p.wallSeconds);
    }
    ChartGroup group{.samples = samples,
                     .seeds = errors.size(),
                     .error = geometricInterval(errors),
                     .medianError = medianOf(errors),
                     .deviceSeconds = timeInterval(device),
                     .wallSeconds = timeInterval(wall)};
    for (const ChartBias& bias : table.biases)
        if (bias.samples == samples && bias.config == config) group.bias = bias.estimate;
    return group;
}

std::vector<uint32_t> samplesOf(const ChartTable& table, const std::string& config) {
    std::vector<uint32_t> samples;
    for (const ChartPoint& p : table.points)
        if (p.config == config) samples.push_back(p.samples);
    std::ranges::sort(samples);
    samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
    return samples;
}

/// Of all points from so many samples on; nothing for less than two of different samples. Errors of 0 have no
/// logarithm.
std::optional<LineFit> fitFrom(const ChartTable& table, const std::string& config, uint32_t first,
                               ErrorMeasure measure) {
    std::vector<double> x, y;
    for (const ChartPoint& p : table.points) {
        if (p.config != config || p.samples < first || !(p.error(measure) > 0.0)) continue;
        x.push_back(std::log(p.samples));
        y.push_back(std::log(p.error(measure)));
    }
    if (x.empty() || std::ranges::min(x) == std::ranges::max(x)) return std::nullopt;
    return fitLine(x, y);
}

Interval biasOf(const ChartCurve& curve) {
    for (size_t i = curve.groups.size(); i-- > 0;) {
        const std::optional<BiasEstimate>& bias = curve.groups[i].bias;
        if (!bias || std::isnan(bias->biasSquared)) continue;
        const auto root = [](double square) { return std::sqrt(std::max(0.0, square)); };
        const double half = kBiasStandardErrors * bias->standardError;
        return {root(bias->biasSquared), root(bias->biasSquared - half), root(bias->biasSquared + half)};
    }
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none};
}

/// Bias counts as the reason only where it is a good part of what is left: every approximation has a trace of it. FLIP
/// cannot be compared with the bias, which is relative then.
Plateau explain(const ChartCurve& curve, ErrorMeasure measure, double referenceNoise) {
    if (curve.groups.empty()) return Plateau::none;
    const double meanSquare = curve.groups.back().error.value * curve.groups.back().error.value;
    const bool isFlat = curve.tail && curve.tail->degrees > 0 && curve.tail->slopeInterval().low > kPlateauSlope;
    const double bias = curve.bias.value;
    const bool isMostlyBias = measure != ErrorMeasure::flip && bias * bias > 0.5 * meanSquare;
    if (curve.bias.low > 0.0 && (isFlat || isMostlyBias)) return Plateau::bias;
    if (!isFlat) return Plateau::none;
    return referenceNoise > kReferenceShare * meanSquare ? Plateau::referenceNoise : Plateau::unexplained;
}

ChartCurve makeCurve(const ChartTable& table, const std::string& config, ErrorMeasure measure, double referenceNoise) {
    ChartCurve curve;
    curve.config = config;
    for (const uint32_t samples : samplesOf(table, config))
        curve.groups.push_back(makeGroup(table, config, samples, measure));
    if (curve.groups.empty()) return curve;
    curve.fit = fitFrom(table, config, curve.groups.front().samples, measure);
    const size_t count = curve.groups.size();
    if (count >= kFewestTailGroups) {
        const size_t tail = std::max(kFewestTailGroups, (count + 1) / 2);
        curve.tail = fitFrom(table, config, curve.groups[count - tail].samples, measure);
    }
    curve.bias = biasOf(curve);
    curve.plateau = explain(curve, measure, referenceNoise);
    return curve;
}

// Configurations that trace the same paths differ by roundings alone: that is no accuracy to pay for.
constexpr double kSameError = 1e-3;

bool dominates(const ChartGroup& a, const ChartGroup& b) {
    const double timeA = a.deviceSeconds.value, timeB = b.deviceSeconds.value;
    const double errorA = a.error.value, errorB = b.error.value;
    return timeA <= timeB && errorA <= errorB * (1.0 + kSameError) &&
           (timeA < timeB || errorA < errorB * (1.0 - kSameError));
}

bool surelyDominates(const ChartGroup& a, const ChartGroup& b) {
    return a.deviceSeconds.high < b.deviceSeconds.low && a.error.high < b.error.low;
}

double interpolateLog(double x0, double y0, double x1, double y1, double x) {
    const double part = (std::log(x) - std::log(x0)) / (std::log(x1) - std::log(x0));
    return std::exp(std::log(y0) + part * (std::log(y1) - std::log(y0)));
}

/// Where the curve of one end of the errors' intervals falls to `error`: infinity for never, 0 for before the first.
double crossing(const ChartCurve& curve, double Interval::*end, double error) {
    for (size_t i = 0; i < curve.groups.size(); ++i) {
        const double after = curve.groups[i].error.*end;
        if (!(after <= error)) continue;
        if (i == 0) return 0.0;
        const double before = curve.groups[i - 1].error.*end;
        return interpolateLog(before, curve.groups[i - 1].deviceSeconds.value, after,
                              curve.groups[i].deviceSeconds.value, error);
    }
    return std::numeric_limits<double>::infinity();
}

/// 1, 2, 5 times powers of ten within the range.
std::vector<double> roundValues(double low, double high) {
    std::vector<double> values;
    if (!(low > 0.0) || !(high >= low) || !std::isfinite(high)) return values;
    for (int power = static_cast<int>(std::floor(std::log10(low))); std::pow(10.0, power) <= high; ++power)
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10.0, power);
            if (value >= low && value <= high) values.push_back(value);
        }
    return values;
}

/// At most so many of them, evenly, with the last.
std::vector<double> thinned(const std::vector<double>& values, size_t most) {
    if (values.size() <= most) return values;
    std::vector<double> kept;
    for (size_t i = 0; i < most; ++i) kept.push_back(values[(i + 1) * values.size() / most - 1]);
    return kept;
}

constexpr size_t kMostTableRows = 6;

}  // namespace

std::string_view nameOf(Plateau plateau) {
    constexpr std::array<std::string_view, 4> names = {"none", "bias", "reference-noise", "unexplained"};
    return names[static_cast<size_t>(plateau)];
}

std::vector<ChartCurve> analyseChart(const ChartTable& table, const std::vector<std::string>& configs,
                                     ErrorMeasure measure, const std::vector<double>& referenceNoise) {
    std::vector<ChartCurve> curves;
    for (size_t i = 0; i < configs.size(); ++i)
        curves.push_back(makeCurve(table, configs[i], measure, referenceNoise[i]));
    markPareto(curves);
    return curves;
}

std::vector<ChartMark> marksOf(const ChartTable& table, const std::vector<ChartCurve>& curves) {
    std::vector<ChartMark> marks;
    for (const ChartPoint& point : table.points) {
        ChartMark& mark = marks.emplace_back();
        for (const ChartCurve& curve : curves)
            for (const ChartGroup& group : curve.groups)
                if (curve.config == point.config && group.samples == point.samples)
                    mark = {group.error.low, group.error.high, group.pareto, group.paretoPossible};
    }
    return marks;
}

void markPareto(std::vector<ChartCurve>& curves) {
    for (ChartCurve& curve : curves)
        for (ChartGroup& group : curve.groups) {
            group.pareto = group.paretoPossible = true;
            for (const ChartCurve& otherCurve : curves)
                for (const ChartGroup& other : otherCurve.groups) {
                    if (dominates(other, group)) group.pareto = false;
                    if (surelyDominates(other, group)) group.paretoPossible = false;
                }
        }
}

std::optional<Interval> errorAtTime(const ChartCurve& curve, double seconds) {
    for (size_t i = 0; i < curve.groups.size(); ++i) {
        const ChartGroup& b = curve.groups[i];
        if (b.deviceSeconds.value == seconds) return b.error;
        if (i == 0 || b.deviceSeconds.value < seconds) continue;
        const ChartGroup& a = curve.groups[i - 1];
        if (a.deviceSeconds.value > seconds) return std::nullopt;
        const auto at = [&](double Interval::*end) {
            return interpolateLog(a.deviceSeconds.value, a.error.*end, b.deviceSeconds.value, b.error.*end, seconds);
        };
        return Interval{at(&Interval::value), at(&Interval::low), at(&Interval::high)};
    }
    return std::nullopt;
}

std::optional<Interval> timeToError(const ChartCurve& curve, double error) {
    const double value = crossing(curve, &Interval::value, error);
    if (value == 0.0 || std::isinf(value)) return std::nullopt;
    return Interval{value, crossing(curve, &Interval::low, error), crossing(curve, &Interval::high, error)};
}

std::vector<double> tableErrors(const std::vector<ChartCurve>& curves) {
    double low = std::numeric_limits<double>::infinity(), high = 0.0;
    for (const ChartCurve& curve : curves)
        for (const ChartGroup& group : curve.groups) {
            low = std::min(low, group.error.value);
            high = std::max(high, group.error.value);
        }
    std::vector<double> values = roundValues(low, high);
    std::erase_if(values, [&](double error) {
        return std::ranges::none_of(curves, [&](const ChartCurve& c) { return timeToError(c, error).has_value(); });
    });
    return thinned(values, kMostTableRows);
}

std::vector<double> tableTimes(const std::vector<ChartCurve>& curves) {
    double low = std::numeric_limits<double>::infinity(), high = 0.0;
    for (const ChartCurve& curve : curves)
        for (const ChartGroup& group : curve.groups) {
            low = std::min(low, group.deviceSeconds.value);
            high = std::max(high, group.deviceSeconds.value);
        }
    return thinned(roundValues(low, high), kMostTableRows);
}

std::optional<ChartBest> bestOf(const std::vector<std::optional<Interval>>& figures) {
    std::optional<ChartBest> best;
    for (size_t i = 0; i < figures.size(); ++i)
        if (figures[i] && (!best || figures[i]->value < best->value.value)) best = ChartBest{i, *figures[i], {}};
    if (!best) return best;
    for (size_t i = 0; i < figures.size(); ++i)
        if (figures[i] && i != best->curve && figures[i]->low <= best->value.high) best->ties.push_back(i);
    return best;
}

}  // namespace raylab
