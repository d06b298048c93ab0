#include "engine/measure/image_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/error.h"
#include "engine/image/srgb.h"

namespace raylab {
namespace {

constexpr double kHeatLowestLog10 = -4.0;
constexpr double kHeatHighestLog10 = 2.0;

/// Calls visit(x, y, a, b) with the channels of each pixel that counts, in both images.
template <typename Visit>
void forEachPixel(const Bitmap& image, const Bitmap& reference, std::span<const uint8_t> mask, const Visit& visit) {
    requireMaskFits(mask, image);
    size_t i = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x, ++i)
            if (mask.empty() || mask[i] != 0) visit(x, y, image.at(x, y), reference.at(x, y));
}

double relativeSquare(double value, double reference) {
    const double difference = value - reference;
    return difference * difference / (reference * reference + kRelMseEpsilon);
}

double displayEncoded(float value) { return linearToSrgb(std::clamp(value, 0.0f, 1.0f)); }

/// The z that a standard normal variable exceeds in size with probability `significance`, by bisection.
double criticalZ(double significance) {
    double low = 0.0;
    double high = 40.0;  // erfc underflows before
    while (true) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) return high;
        (std::erfc(middle / std::sqrt(2.0)) > significance ? low : high) = middle;
    }
}

bool passes(double a, double b, double varianceA, double varianceB, double threshold) {
    if (!std::isfinite(a) || !std::isfinite(b) || !(varianceA >= 0.0) || !(varianceB >= 0.0)) return false;
    const double variance = varianceA + varianceB;
    return std::isfinite(variance) && (a - b) * (a - b) <= threshold * threshold * variance;
}

}  // namespace

ImageError compareImages(const Bitmap& image, const Bitmap& reference, std::span<const uint8_t> mask) {
    requireSameShape(image, reference);
    const int channels = colorChannels(image);
    ImageError error;
    double squares = 0.0, relativeSquares = 0.0, displaySquares = 0.0;
    forEachPixel(image, reference, mask, [&](int, int, const float* a, const float* b) {
        if (!isFinite(a, channels) || !isFinite(b, channels)) {
            ++error.nonFinite;
            return;
        }
        ++error.pixels;
        for (int c = 0; c < channels; ++c) {
            const double difference = double{a[c]} - double{b[c]};
            const double displayDifference = displayEncoded(a[c]) - displayEncoded(b[c]);
            squares += difference * difference;
            relativeSquares += relativeSquare(a[c], b[c]);
            displaySquares += displayDifference * displayDifference;
            error.maxAbs = std::max(error.maxAbs, std::abs(difference));
        }
    });
    const double count = static_cast<double>(error.pixels) * channels;
    const auto mean = [&](double sum) { return count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN(); };
    error.mse = mean(squares);
    error.rmse = std::sqrt(error.mse);
    error.relMse = mean(relativeSquares);
    error.psnr = -10.0 * std::log10(mean(displaySquares));
    if (error.pixels == 0) error.maxAbs = error.mse;
    return error;
}

Bitmap errorHeatMap(const Bitmap& image, const Bitmap& reference, std::span<const uint8_t> mask) {
    requireSameShape(image, reference);
    const int channels = colorChannels(image);
    Bitmap map(image.width, image.height, 1);
    forEachPixel(image, reference, mask, [&](int x, int y, const float* a, const float* b) {
        double sum = 0.0;
        for (int c = 0; c < channels; ++c) sum += relativeSquare(a[c], b[c]);
        const bool finite = isFinite(a, channels) && isFinite(b, channels);
        // -infinity for no error, which is black
        *map.at(x, y) =
            finite ? static_cast<float>(std::log10(sum / channels)) : std::numeric_limits<float>::quiet_NaN();
    });
    return heatPicture(map, kHeatLowestLog10, kHeatHighestLog10, mask);
}

ZTest zTest(const Bitmap& image, const Bitmap& varianceOfMean, const Bitmap& reference,
            const Bitmap& referenceVarianceOfMean, double significance, std::span<const uint8_t> mask) {
    requireSameShape(image, reference);
    requireSameShape(image, varianceOfMean);
    requireSameShape(image, referenceVarianceOfMean);
    requireMaskFits(mask, image);
    if (!(significance > 0.0 && significance < 1.0))
        throw Error("a significance of " + std::to_string(significance) + " is no probability; give one such as 0.01");
    const int channels = colorChannels(image);
    ZTest test;
    test.significance = significance;
    const auto leftOut = std::ranges::count(mask, uint8_t{0});
    test.pixels = image.pixelCount() - static_cast<size_t>(leftOut);
    if (test.pixels == 0) throw Error("no pixel of the images counts; there is nothing to test");
    const double tests = static_cast<double>(test.pixels) * channels;
    test.threshold = criticalZ(-std::expm1(std::log1p(-significance) / tests));

    size_t passing = 0;
    forEachPixel(image, reference, mask, [&](int x, int y, const float* a, const float* b) {
        const float* varianceA = varianceOfMean.at(x, y);
        const float* varianceB = referenceVarianceOfMean.at(x, y);
        bool all = true;
        for (int c = 0; c < channels; ++c) all &= passes(a[c], b[c], varianceA[c], varianceB[c], test.threshold);
        passing += all;
    });
    test.passFraction = static_cast<double>(passing) / static_cast<double>(test.pixels);
    test.passed = passing == test.pixels;
    return test;
}

}  // namespace raylab
