#include "engine/measure/ssim.h"

#include <algorithm>
#include <limits>

#include "engine/image/srgb.h"
#include "engine/measure/image_pair.h"
#include "engine/measure/plane_filter.h"

namespace raylab {
namespace {

constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01;  ///< (K1 L)^2
constexpr double kC2 = 0.03 * 0.03;  ///< (K2 L)^2
constexpr int kBorder = kSsimWindow / 2;

using PlaneD = Plane<double>;  // variances are differences of nearly equal means: float would leave 4 digits

PlaneD encodedChannel(const Bitmap& bitmap, int channel, const PixelMask& blackened) {
    PlaneD plane(bitmap.width, bitmap.height);
    for (size_t i = 0; i < plane.values.size(); ++i) {
        const float value = bitmap.pixels[i * static_cast<size_t>(bitmap.channels) + static_cast<size_t>(channel)];
        plane.values[i] = blackened[i] != 0 ? 0.0 : double{linearToSrgb(std::clamp(value, 0.0f, 1.0f))};
    }
    return plane;
}

PlaneD windowMeanOfProduct(const PlaneD& a, const PlaneD& b, std::span<const double> window) {
    PlaneD product(a.width, a.height);
    std::ranges::transform(a.values, b.values, product.values.begin(), std::multiplies());
    return filterSeparable(product, window, window);
}

/// Equation 13 of the paper.
double similarity(double meanA, double meanB, double squareA, double squareB, double product) {
    const double varianceA = squareA - meanA * meanA, varianceB = squareB - meanB * meanB;
    const double covariance = product - meanA * meanB;
    return (2.0 * meanA * meanB + kC1) * (2.0 * covariance + kC2) /
           ((meanA * meanA + meanB * meanB + kC1) * (varianceA + varianceB + kC2));
}

void addChannel(PlaneD& sum, const PlaneD& a, const PlaneD& b) {
    const std::vector<double> window = gaussianTaps(kSigma, kBorder);
    const std::span<const double> taps(window);
    const PlaneD meanA = filterSeparable(a, taps, taps), meanB = filterSeparable(b, taps, taps);
    const PlaneD squareA = windowMeanOfProduct(a, a, taps), squareB = windowMeanOfProduct(b, b, taps);
    const PlaneD product = windowMeanOfProduct(a, b, taps);
    for (size_t i = 0; i < sum.values.size(); ++i)
        sum.values[i] +=
            similarity(meanA.values[i], meanB.values[i], squareA.values[i], squareB.values[i], product.values[i]);
}

}  // namespace

Bitmap ssimMap(const Bitmap& image, const Bitmap& reference) {
    requireSameShape(image, reference);
    const PixelMask nonFinite = nonFinitePixels(image, reference);
    const int channels = colorChannels(image);
    PlaneD sum(image.width, image.height);
    for (int c = 0; c < channels; ++c)
        addChannel(sum, encodedChannel(image, c, nonFinite), encodedChannel(reference, c, nonFinite));

    Bitmap map(image.width, image.height, 1);
    std::ranges::fill(map.pixels, std::numeric_limits<float>::quiet_NaN());
    for (int y = kBorder; y < image.height - kBorder; ++y)
        for (int x = kBorder; x < image.width - kBorder; ++x) {
            const size_t i = static_cast<size_t>(y) * static_cast<size_t>(image.width) + static_cast<size_t>(x);
            if (nonFinite[i] == 0) map.pixels[i] = static_cast<float>(sum.values[i] / channels);
        }
    return map;
}

}  // namespace raylab
