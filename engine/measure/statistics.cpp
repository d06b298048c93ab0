#include "engine/measure/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace raylab {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// P(|T| <= t).
double studentWithin(double t, size_t degrees) {
    const double angle = std::atan(t / std::sqrt(static_cast<double>(degrees)));
    const double cosine = std::cos(angle), squared = cosine * cosine;
    const bool odd = degrees % 2 == 1;
    if (degrees == 1) return 2.0 * angle / std::numbers::pi;
    double term = odd ? cosine : 1.0, sum = term;
    for (size_t i = odd ? 3 : 2; i + (odd ? 1 : 0) < degrees; i += 2) {
        term *= squared * static_cast<double>(i - 1) / static_cast<double>(i);
        sum += term;
    }
    const double part = std::sin(angle) * sum;
    return odd ? 2.0 / std::numbers::pi * (angle + part) : part;
}

double meanOfValues(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double studentQuantile(double confidence, size_t degrees) {
    assert(confidence > 0.0 && confidence < 1.0 && degrees > 0);
    double low = 0.0, high = 1.0;
    while (studentWithin(high, degrees) < confidence) high *= 2.0;
    while (true) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) return high;
        (studentWithin(middle, degrees) < confidence ? low : high) = middle;
    }
}

double medianOf(std::span<const double> values) {
    if (values.empty()) return kNaN;
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    const size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

Interval meanInterval(std::span<const double> values, double confidence) {
    if (values.empty()) return {kNaN, kNaN, kNaN};
    const double mean = meanOfValues(values);
    if (values.size() < 2) return {mean, kNaN, kNaN};
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    const double count = static_cast<double>(values.size());
    const double half = studentQuantile(confidence, values.size() - 1) * std::sqrt(squares / (count - 1.0) / count);
    return {mean, mean - half, mean + half};
}

Interval geometricInterval(std::span<const double> values, double confidence) {
    std::vector<double> logs(values.size());
    std::ranges::transform(values, logs.begin(), [](double value) { return std::log(value); });
    const Interval interval = meanInterval(logs, confidence);
    return {std::exp(interval.value), std::exp(interval.low), std::exp(interval.high)};
}

Interval LineFit::slopeInterval(double confidence) const {
    if (degrees == 0) return {slope, kNaN, kNaN};
    const double half = studentQuantile(confidence, degrees) * slopeError;
    return {slope, slope - half, slope + half};
}

LineFit fitLine(std::span<const double> x, std::span<const double> y) {
    assert(x.size() == y.size() && x.size() >= 2);
    const double meanX = meanOfValues(x), meanY = meanOfValues(y);
    double xx = 0.0, xy = 0.0;
    for (size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - meanX) * (x[i] - meanX);
        xy += (x[i] - meanX) * (y[i] - meanY);
    }
    LineFit fit;
    fit.slope = xy / xx;
    fit.intercept = meanY - fit.slope * meanX;
    fit.degrees = x.size() - 2;
    double residuals = 0.0;
    for (size_t i = 0; i < x.size(); ++i) {
        const double residual = y[i] - fit.intercept - fit.slope * x[i];
        residuals += residual * residual;
    }
    fit.slopeError = fit.degrees > 0 ? std::sqrt(residuals / static_cast<double>(fit.degrees) / xx) : kNaN;
    return fit;
}

}  // namespace raylab
