#pragma once

#include <cstdint>
#include <vector>

#include "engine/image/bitmap.h"

namespace raylab {

/// What images of one configuration, alike but for their seeds, say of its bias and variance. All three are means over
/// the pixels and channels, weighted as the charted error is.
struct BiasEstimate {
    double biasSquared = 0.0;    ///< unbiased, so it may be negative; NaN from fewer than two images
    double standardError = 0.0;  ///< of biasSquared
    double variance = 0.0;       ///< of one image
};

/// What images are measured against.
struct ReferenceImage {
    Bitmap mean;
    Bitmap varianceOfMean;  ///< as large as `mean`; all 0 where the reference is exact
    /// Independent parts that varianceOfMean was estimated from; 0 where it is taken for exact.
    int parts = 0;
};

/// Weights of squared differences in each channel of each pixel: 1, or 1 / (reference^2 + kRelMseEpsilon) where
/// `relative`; 0 in pixels that are not finite in the reference.
Bitmap errorWeights(const Bitmap& reference, bool relative);

/// Weighted mean of the reference's own variance: what it adds to every squared error that is measured against it.
double referenceNoise(const ReferenceImage& reference, const Bitmap& weights);

/// Mean and variance in each pixel over images that come one by one, in double precision (Welford 1962).
class SeedImages {
public:
    SeedImages(int width, int height, int channels);
    /// From what mean(), variance() and count() gave.
    SeedImages(const Bitmap& mean, const Bitmap& variance, uint32_t count);

    /// Adds an image of that shape, with 3 channels or 1. Values that are not finite count as 0.
    void add(const Bitmap& image);

    uint32_t count() const { return count_; }
    Bitmap mean() const;
    Bitmap variance() const;  ///< of one image; 0 from fewer than two

    /// Of K images with pixel values x_k, against a reference value r with variance v (m, s^2: mean and variance of
    /// x_k):
    ///     bias^2 = (m - r)^2 - s^2 / K - v,
    /// which is the mean of (x_j - r)(x_k - r) over pairs j != k, less v: a U-statistic (Hoeffding 1948). Its variance,
    /// from the second moments alone, is 4 b^2 (s^2/K + v) + 2 s^4 / (K (K-1)) + 4 v s^2/K + 2 v^2 (1 + 1/(parts-1));
    /// pixels are taken for independent, and the channels of a pixel for fully dependent (an upper bound).
    BiasEstimate estimate(const ReferenceImage& reference, const Bitmap& weights) const;

private:
    int width_, height_, channels_;
    uint32_t count_ = 0;
    std::vector<double> mean_;
    std::vector<double> squares_;  ///< sum of squared deviations from the mean
};

}  // namespace raylab
