#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/measure/image_pair.h"

namespace raylab {

/// Keeps the relative error of dark pixels finite: where the reference is below sqrt(kRelMseEpsilon) = 0.1, relMse
/// turns into an absolute error.
constexpr double kRelMseEpsilon = 1e-2;

/// Means over the colour channels of all pixels that count and are finite in both images; NaN where there is none.
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
    size_t nonFinite = 0;  ///< pixels that count and yet are left out: a channel of either image is infinite or NaN
};

/// Compares RGB (alpha is left out), or the one channel of grey images. Throws Error where sizes differ, also the
/// mask's, or one is grey.
ImageError compareImages(const Bitmap& image, const Bitmap& reference, std::span<const uint8_t> mask = {});

/// The squared relative error of each pixel (mean over its channels, as in relMse) as a heatPicture() on a logarithmic
/// scale from 1e-4 (black) to 1e2 (white); pixels that are not finite in either image are cyan. Throws as compareImages
/// does.
Bitmap errorHeatMap(const Bitmap& image, const Bitmap& reference, std::span<const uint8_t> mask = {});

/// What the Z-test of two noisy images found.
struct ZTest {
    double passFraction = 0.0;  ///< of pixels in which each channel passes
    size_t pixels = 0;          ///< tested
    double threshold = 0.0;     ///< largest |z| that passes, in standard errors
    double significance = 0.0;  ///< that was asked for
    bool passed = false;        ///< no pixel fails: "equal means" is not rejected
};

/// Two-sided Z-test in each pixel and colour channel of "both estimators have the same mean": Subr and Arvo,
/// "Statistical Hypothesis Testing for Assessing Monte Carlo Estimators", 2007, as Mitsuba tests its renderings. z =
/// (a-b) / sqrt(varianceOfMean + referenceVarianceOfMean), where the variance of a mean is that of one sample divided
/// by the number of samples. `significance`, in (0,1), is the probability that equal estimators fail anywhere: Sidak's
/// correction (1967) makes it 1 - (1-significance)^(1/n) for each of the n tests. Without variance only equal values
/// pass. A value that is not finite or a negative variance fails; where a variance was estimated so roughly that it is
/// negative (Mitsuba's reference files), raise it before (Mitsuba: to 1e-4 a sample). Throws Error where the four
/// or the mask differ in size or channels, or no pixel counts.
ZTest zTest(const Bitmap& image, const Bitmap& varianceOfMean, const Bitmap& reference,
            const Bitmap& referenceVarianceOfMean, double significance = 0.01, std::span<const uint8_t> mask = {});

}  // namespace raylab
