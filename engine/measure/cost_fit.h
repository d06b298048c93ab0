#pragma once

#include <cstddef>
#include <span>

namespace raylab {

/// What rays of one kind took and did, on average.
struct CostSample {
    double nsPerRay = 0.0;  ///< positive
    double nodes = 0.0;     ///< per ray, as the two below
    double triangles = 0.0;
};

struct Estimate {
    double value = 0.0;
    double standardError = 0.0;
};

/// ns a ray = constant + node * nodes + triangle * triangles.
struct CostFit {
    Estimate constant;  ///< ns
    Estimate node;      ///< ns each
    Estimate triangle;  ///< ns each
    /// A triangle's cost over a node's: what --intersection-cost is where --traversal-cost is 1. Its error by the
    /// covariance of the two (to first order); infinite where no cost of a node was found.
    Estimate ratio;
    double relativeResidual = 0.0;  ///< root mean square of what is left over, in parts of the measured times
    size_t samples = 0;
};

/// Weighted least squares. Times are noisy in proportion to themselves, so that each sample weighs 1 / time^2; the size
/// of the noise is taken from the residuals, with samples - 3 degrees of freedom. Throws Error for fewer than four
/// samples and where the counters do not tell nodes from triangles (or from the constant).
CostFit fitCosts(std::span<const CostSample> samples);

}  // namespace raylab
