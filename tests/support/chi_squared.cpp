#include "tests/support/chi_squared.h"

#include <cmath>
#include <numeric>

namespace raylab::support {
namespace {

constexpr double kPrecision = 1e-14;

/// Lower function by its series, for x < a + 1.
double lowerSeries(double a, double x) {
    double term = 1.0 / a, sum = term;
    for (double n = a + 1.0; term > kPrecision * sum; n += 1.0) {
        term *= x / n;
        sum += term;
    }
    return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Upper function by its continued fraction in the form 1/(x+1-a - 1(1-a)/(x+3-a - 2(2-a)/(x+5-a - ...))), from the
/// end.
double upperFraction(double a, double x) {
    double fraction = 0.0;
    for (int n = 2000; n > 0; --n) fraction = n * (n - a) / (x + 2.0 * n + 1.0 - a - fraction);
    return std::exp(a * std::log(x) - x - std::lgamma(a)) / (x + 1.0 - a - fraction);
}

}  // namespace

double chiSquaredTail(double value, double degrees) {
    const double a = 0.5 * degrees, x = 0.5 * value;
    if (x <= 0.0) return 1.0;
    return x < a + 1.0 ? 1.0 - lowerSeries(a, x) : upperFraction(a, x);
}

double chiSquaredTest(std::span<const size_t> counts, std::span<const double> probabilities) {
    const auto total = static_cast<double>(std::accumulate(counts.begin(), counts.end(), size_t{0}));
    double value = 0.0, restExpected = 0.0, restCount = 0.0;
    int bins = 0;
    const auto add = [&](double count, double expected) {
        value += (count - expected) * (count - expected) / expected;
        ++bins;
    };
    for (size_t i = 0; i < counts.size(); ++i) {
        const double expected = probabilities[i] * total;
        const auto count = static_cast<double>(counts[i]);
        if (expected <= 0.0 && count > 0.0) return 0.0;
        if (expected >= 5.0) {
            add(count, expected);
        } else {
            restExpected += expected;
            restCount += count;
        }
    }
    if (restExpected > 0.0) add(restCount, restExpected);
    return chiSquaredTail(value, bins - 1.0);
}

}  // namespace raylab::support
