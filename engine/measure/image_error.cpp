#include "engine/measure/image_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/error.h"
#include "engine/image/srgb.h"

namespace raylab {
namespace {

constexpr double kHeatLowestLog10 = -4.0;
constexpr double kHeatHighestLog10 = 2.0;

using Rgb = std::array<float, 3>;

/// sRGB-encoded, evenly spaced: CIE lightness 0, 20, 39, 57, 78 and 99.
constexpr std::array<Rgb, 6> kHeatRamp = {{{0.000f, 0.000f, 0.000f},
                                           {0.275f, 0.059f, 0.471f},
                                           {0.647f, 0.157f, 0.412f},
                                           {0.902f, 0.373f, 0.176f},
                                           {0.980f, 0.706f, 0.196f},
                                           {1.000f, 1.000f, 0.863f}}};
constexpr Rgb kHeatNonFinite = {0.0f, 1.0f, 1.0f};

int colorChannels(const Bitmap& bitmap) { return bitmap.channels >= 3 ? 3 : 1; }

std::string describe(const Bitmap& bitmap) {
    return std::to_string(bitmap.width) + " x " + std::to_string(bitmap.height) +
           (colorChannels(bitmap) == 3 ? " (colour)" : " (grey)");
}

void requireSameShape(const Bitmap& image, const Bitmap& reference) {
    const bool same = image.width == reference.width && image.height == reference.height &&
                      colorChannels(image) == colorChannels(reference);
    if (!same)
        throw Error("the images cannot be compared: " + describe(image) + " pixels against " + describe(reference) +
                    "; give two of the same size");
}

/// Calls visit(x, y, a, b) with the pixel's channels in both images.
template <typename Visit>
void forEachPixel(const Bitmap& image, const Bitmap& reference, const Visit& visit) {
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) visit(x, y, image.at(x, y), reference.at(x, y));
}

bool allFinite(const float* pixel, int channels) {
    return std::all_of(pixel, pixel + channels, [](float value) { return std::isfinite(value); });
}

double relativeSquare(double value, double reference) {
    const double difference = value - reference;
    return difference * difference / (reference * reference + kRelMseEpsilon);
}

double displayEncoded(float value) { return linearToSrgb(std::clamp(value, 0.0f, 1.0f)); }

Rgb heatColor(double relativeSquaredError) {
    const double range = kHeatHighestLog10 - kHeatLowestLog10;
    const double scaled = (std::log10(relativeSquaredError) - kHeatLowestLog10) / range;  // -infinity for no error
    const double position = std::clamp(scaled, 0.0, 1.0) * (kHeatRamp.size() - 1);
    const size_t segment = std::min(static_cast<size_t>(position), kHeatRamp.size() - 2);
    const float t = static_cast<float>(position - static_cast<double>(segment));
    Rgb color{};
    for (size_t c = 0; c < 3; ++c)
        color[c] = srgbToLinear(std::lerp(kHeatRamp[segment][c], kHeatRamp[segment + 1][c], t));
    return color;
}

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

ImageError compareImages(const Bitmap& image, const Bitmap& reference) {
    requireSameShape(image, reference);
    const int channels = colorChannels(image);
    ImageError error;
    double squares = 0.0, relativeSquares = 0.0, displaySquares = 0.0;
    forEachPixel(image, reference, [&](int, int, const float* a, const float* b) {
        if (!allFinite(a, channels) || !allFinite(b, channels)) {
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

Bitmap errorHeatMap(const Bitmap& image, const Bitmap& reference) {
    requireSameShape(image, reference);
    const int channels = colorChannels(image);
    Bitmap heat(image.width, image.height, 3);
    forEachPixel(image, reference, [&](int x, int y, const float* a, const float* b) {
        double sum = 0.0;
        for (int c = 0; c < channels; ++c) sum += relativeSquare(a[c], b[c]);
        const bool finite = allFinite(a, channels) && allFinite(b, channels);
        std::ranges::copy(finite ? heatColor(sum / channels) : kHeatNonFinite, heat.at(x, y));
    });
    return heat;
}

ZTest zTest(const Bitmap& image, const Bitmap& varianceOfMean, const Bitmap& reference,
            const Bitmap& referenceVarianceOfMean, double significance) {
    requireSameShape(image, reference);
    requireSameShape(image, varianceOfMean);
    requireSameShape(image, referenceVarianceOfMean);
    if (!(significance > 0.0 && significance < 1.0))
        throw Error("a significance of " + std::to_string(significance) + " is no probability; give one such as 0.01");
    const int channels = colorChannels(image);
    ZTest test;
    test.pixels = image.pixelCount();
    if (test.pixels == 0) throw Error("the images are empty; there is nothing to test");
    const double tests = static_cast<double>(test.pixels) * channels;
    test.threshold = criticalZ(-std::expm1(std::log1p(-significance) / tests));

    size_t passing = 0;
    forEachPixel(image, reference, [&](int x, int y, const float* a, const float* b) {
        const float* varianceA = varianceOfMean.at(x, y);
        const float* varianceB = referenceVarianceOfMean.at(x, y);
        bool all = true;
        for (int c = 0; c < channels; ++c) all &= passes(a[c], b[c], varianceA[c], varianceB[c], test.threshold);
        passing += all;
    });
    test.passFraction = static_cast<double>(passing) / static_cast<double>(test.pixels);
    return test;
}

}  // namespace raylab
