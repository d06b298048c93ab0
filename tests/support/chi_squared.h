#pragma once

#include <cstddef>
#include <span>

namespace raylab::support {

/// Probability that a chi-squared variable of so many degrees of freedom exceeds `value`: the regularised upper
/// incomplete gamma function (Abramowitz, Stegun, "Handbook of Mathematical Functions", 26.4.19; series 6.5.29,
/// fraction 6.5.31).
double chiSquaredTail(double value, double degrees);

/// Pearson's test of counts against the probabilities of their bins, which add up to 1. Bins of fewer than five
/// expected counts are taken together. Returns the probability to see counts that fit no better; 0 where something fell
/// into a bin that is impossible.
double chiSquaredTest(std::span<const size_t> counts, std::span<const double> probabilities);

}  // namespace raylab::support
