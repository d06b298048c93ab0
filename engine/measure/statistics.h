#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace raylab {

/// Of every interval, unless its place says otherwise.
constexpr double kConfidence = 0.95;

/// An estimate and the ends of its confidence interval. Without any spread known, both ends are NaN.
struct Interval {
    double value = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// The t that |T| is at most with probability `confidence`, for Student's distribution with so many degrees of freedom:
/// the finite sums of Abramowitz and Stegun, "Handbook of Mathematical Functions", 1964, 26.7.3 and 26.7.4, inverted by
/// bisection. `confidence` in (0,1), one degree at least.
double studentQuantile(double confidence, size_t degrees);

/// Middle value, or the mean of the middle two; NaN for none.
double medianOf(std::span<const double> values);

/// Mean, with Student's interval: exact for normal values.
Interval meanInterval(std::span<const double> values, double confidence = kConfidence);

/// Geometric mean of positive values, with Student's interval of their logarithms: for errors and times, whose noise is
/// a factor.
Interval geometricInterval(std::span<const double> values, double confidence = kConfidence);

/// y = intercept + slope x by least squares.
struct LineFit {
    double intercept = 0.0;
    double slope = 0.0;
    double slopeError = 0.0;  ///< standard error of the slope from the residuals; NaN for two values
    size_t degrees = 0;       ///< of freedom of that error: values - 2

    /// Student's interval of the slope; NaN ends without degrees of freedom.
    Interval slopeInterval(double confidence = kConfidence) const;
};

/// `x` and `y` as long, of two different x at least. The error of the slope is right where the errors of y are
/// independent and of one size.
LineFit fitLine(std::span<const double> x, std::span<const double> y);

}  // namespace raylab
