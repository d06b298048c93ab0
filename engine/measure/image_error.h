#pragma once

#include <cstddef>

#include "engine/image/bitmap.h"

namespace raylab {

/// Keeps the relative error of dark pixels finite: where the reference is below sqrt(kRelMseEpsilon) = 0.1, relMse
/// turns into an absolute error.
constexpr double kRelMseEpsilon = 1e-2;

/// Means over the colour channels of all pixels that are finite in both images; NaN where there is none.
struct ImageError {
    double mse = 0.0;   ///< mean of (a-b)^2, linear
    double rmse = 0.0;  ///< sqrt(mse)
    /// Mean of (a-b)^2 / (b^2 + kRelMseEpsilon), b the reference: Rousselle, Knaus, Zwicker, "Adaptive Sampling and
    /// Reconstruction using Greedy Error Minimization", 2011.
    double relMse = 0.0;
    /// dB, peak 1, over values clamped to [0,1] and then sRGB-encoded: what other tools print for 8-bit images of the
    /// two. Infinite for equal images.
    double psnr = 0.0;
    double maxAbs = 0.0;   ///< largest |a-b|, linear
    size_t pixels = 0;     ///< compared
    size_t nonFinite = 0;  ///< pixels left out: a colour channel of either image is infinite or NaN
};

/// Compares RGB (alpha is left out), or the one channel of grey images. Throws Error where sizes differ, or one is
/// grey.
ImageError compareImages(const Bitmap& image, const Bitmap& reference);

/// The squared relative error of each pixel (mean over its channels, as in relMse) as a linear RGB picture for
/// writePng. Logarithmic scale from 1e-4 and less (black) over violet, red and orange to 1e2 and more (white),
/// lightness growing evenly; pixels that are not finite in either image are cyan, which the scale lacks. Throws as
/// compareImages does.
Bitmap errorHeatMap(const Bitmap& image, const Bitmap& reference);

/// What the Z-test of two noisy images found.
struct ZTest {
    double passFraction = 0.0;  ///< of pixels in which each channel passes
    size_t pixels = 0;          ///< tested
    double threshold = 0.0;     ///< largest |z| that passes, in standard errors
};

/// Two-sided Z-test in each pixel and colour channel of "both estimators have the same mean": Subr and Arvo,
/// "Statistical Hypothesis Testing for Assessing Monte Carlo Estimators", 2007, as Mitsuba tests its renderings. z =
/// (a-b) / sqrt(varianceOfMean + referenceVarianceOfMean), where the variance of a mean is that of one sample divided
/// by the number of samples. `significance`, in (0,1), is the probability that equal estimators fail anywhere: Sidak's
/// correction (1967) makes it 1 - (1-significance)^(1/n) for each of the n tests. Without variance only equal values
/// pass. A value that is not finite or a negative variance fails; where a variance was estimated so roughly that it is
/// negative (Mitsuba's reference files), raise it before (Mitsuba: to 1e-4 a sample). Throws Error where the four
/// differ in size or channels, or are empty.
ZTest zTest(const Bitmap& image, const Bitmap& varianceOfMean, const Bitmap& reference,
            const Bitmap& referenceVarianceOfMean, double significance = 0.01);

}  // namespace raylab
