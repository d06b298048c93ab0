#include "engine/measure/flip.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/error.h"
#include "engine/measure/flip_color.h"
#include "engine/measure/image_pair.h"
#include "engine/measure/plane_filter.h"

namespace raylab {
namespace {

using PlaneF = Plane<float>;
using Taps = std::vector<float>;

/// a sqrt(pi/b) exp(-(pi d)^2 / b), d in degrees: a term of the contrast sensitivity functions (FLIP, table 1).
struct CsfTerm {
    double a;
    double b;
};
constexpr CsfTerm kAchromatic = {1.0, 0.0047};
constexpr CsfTerm kRedGreen = {1.0, 0.0053};
constexpr CsfTerm kBlueYellowWide = {34.1, 0.04};
constexpr CsfTerm kBlueYellowNarrow = {13.5, 0.025};

/// Two standard deviations of the feature detectors (FLIP, section 4.2).
constexpr double kFeatureWidthDegrees = 0.082;

double sigmaDegrees(const CsfTerm& term) { return std::sqrt(term.b / 2.0) / std::numbers::pi; }

Taps toFloat(const std::vector<double>& taps) { return {taps.begin(), taps.end()}; }

/// Scales what is positive to a sum of 1 and what is negative to a sum of -1.
void normalizeHalves(std::vector<double>& taps) {
    double positive = 0.0, negative = 0.0;
    for (const double tap : taps) (tap > 0.0 ? positive : negative) += tap;
    for (double& tap : taps) tap /= tap > 0.0 ? positive : -negative;
}

/// All filters of FLIP as one-dimensional taps; a Gaussian and its derivatives are separable.
struct Filters {
    Taps achromatic, redGreen, blueYellowWide, blueYellowNarrow;
    float wideShare = 0.0f;  ///< of the wide term in the blue-yellow filter; the narrow one has the rest
    Taps smooth, edge, point;

    explicit Filters(double pixelsPerDegree) {
        setContrastSensitivity(pixelsPerDegree);
        setFeatureDetectors(0.5 * kFeatureWidthDegrees * pixelsPerDegree);
    }

private:
    void setContrastSensitivity(double pixelsPerDegree) {
        const int radius = static_cast<int>(std::ceil(3.0 * sigmaDegrees(kBlueYellowWide) * pixelsPerDegree));
        const auto taps = [&](const CsfTerm& term) {
            return gaussianTaps(sigmaDegrees(term) * pixelsPerDegree, radius);
        };
        const std::vector<double> wide = taps(kBlueYellowWide), narrow = taps(kBlueYellowNarrow);
        achromatic = toFloat(taps(kAchromatic));
        redGreen = toFloat(taps(kRedGreen));
        blueYellowWide = toFloat(wide);
        blueYellowNarrow = toFloat(narrow);
        // The sum of a term over the pixels: its height times the squared sum of a row, which is 1 / its middle tap.
        const auto volume = [](const CsfTerm& term, double middle) {
            return term.a * std::sqrt(std::numbers::pi / term.b) / (middle * middle);
        };
        const double wideVolume = volume(kBlueYellowWide, wide[static_cast<size_t>(radius)]);
        const double narrowVolume = volume(kBlueYellowNarrow, narrow[static_cast<size_t>(radius)]);
        wideShare = static_cast<float>(wideVolume / (wideVolume + narrowVolume));
    }

    void setFeatureDetectors(double sigma) {
        const int radius = static_cast<int>(std::ceil(3.0 * sigma));
        const std::vector<double> gaussian = gaussianTaps(sigma, radius);
        std::vector<double> first = gaussian, second = gaussian;
        for (int x = -radius; x <= radius; ++x) {
            first[static_cast<size_t>(x + radius)] *= -x;
            second[static_cast<size_t>(x + radius)] *= x * x / (sigma * sigma) - 1.0;
        }
        normalizeHalves(first);
        normalizeHalves(second);
        smooth = toFloat(gaussian);
        edge = toFloat(first);
        point = toFloat(second);
    }
};

/// What an observer makes of an image: colours as the eye resolves them, and the strength of edges and points.
struct Percept {
    PlaneF lightness, a, b;  ///< Hunt-adjusted L*a*b*
    PlaneF edges, points;
};

PlaneF filtered(const PlaneF& input, const Taps& rows, const Taps& columns) {
    return filterSeparable(input, std::span<const float>(rows), std::span<const float>(columns));
}

/// Calls visit(i) for all pixels, in parallel.
template <typename Visit>
void forAllPixels(size_t count, const Visit& visit) {
    using Range = tbb::blocked_range<size_t>;
    tbb::parallel_for(Range(0, count, 16384), [&](const Range& range) {
        for (size_t i = range.begin(); i != range.end(); ++i) visit(i);
    });
}

/// Length of the detector's response along x and along y.
PlaneF featureStrength(const PlaneF& luminance, const Taps& detector, const Taps& smooth) {
    PlaneF alongX = filtered(luminance, detector, smooth);
    const PlaneF alongY = filtered(luminance, smooth, detector);
    std::ranges::transform(alongX.values, alongY.values, alongX.values.begin(),
                           [](float x, float y) { return std::sqrt(x * x + y * y); });
    return alongX;
}

PlaneF blueYellowFiltered(const PlaneF& input, const Filters& filters) {
    PlaneF sum = filtered(input, filters.blueYellowWide, filters.blueYellowWide);
    const PlaneF narrow = filtered(input, filters.blueYellowNarrow, filters.blueYellowNarrow);
    std::ranges::transform(sum.values, narrow.values, sum.values.begin(), [&](float wide, float rest) {
        return filters.wideShare * wide + (1.0f - filters.wideShare) * rest;
    });
    return sum;
}

/// `displayed`: RGB in [0,1]. YCxCz is taken as Y, X - Y and Y - Z relative to white: its scales and its offset cancel
/// around a linear filter that sums to 1.
Percept perceive(const Bitmap& displayed, const Filters& filters) {
    PlaneF y(displayed.width, displayed.height), cx = y, cz = y;
    forAllPixels(displayed.pixelCount(), [&](size_t i) {
        const float* rgb = displayed.pixels.data() + 3 * i;
        const flip::Color xyz = flip::whiteRelativeXyz({rgb[0], rgb[1], rgb[2]});
        y.values[i] = xyz[1];
        cx.values[i] = xyz[0] - xyz[1];
        cz.values[i] = xyz[1] - xyz[2];
    });
    Percept percept = {filtered(y, filters.achromatic, filters.achromatic),
                       filtered(cx, filters.redGreen, filters.redGreen), blueYellowFiltered(cz, filters),
                       featureStrength(y, filters.edge, filters.smooth),
                       featureStrength(y, filters.point, filters.smooth)};
    forAllPixels(displayed.pixelCount(), [&](size_t i) {
        float &lightness = percept.lightness.values[i], &a = percept.a.values[i], &b = percept.b.values[i];
        flip::Color rgb = flip::linearRgb({lightness + a, lightness, lightness - b});
        for (float& channel : rgb) channel = std::clamp(channel, 0.0f, 1.0f);
        const flip::Color lab = flip::huntLab(flip::whiteRelativeXyz(rgb));
        lightness = lab[0];
        a = lab[1];
        b = lab[2];
    });
    return percept;
}

/// FLIP, section 4.3: the colour error to the power of 1 - the feature error, so that features amplify.
float flipOf(const Percept& image, const Percept& reference, size_t i) {
    const auto color = [i](const Percept& p) {
        return flip::Color{p.lightness.values[i], p.a.values[i], p.b.values[i]};
    };
    const float edges = std::abs(image.edges.values[i] - reference.edges.values[i]);
    const float points = std::abs(image.points.values[i] - reference.points.values[i]);
    const float features = std::sqrt(std::max(edges, points) / std::numbers::sqrt2_v<float>);
    return std::pow(flip::colorError(color(image), color(reference)), 1.0f - features);
}

/// Larger of `map` and the FLIP of what a display shows of the two images.
void raiseToFlip(Bitmap& map, const Bitmap& image, const Bitmap& reference, const Filters& filters) {
    const Percept a = perceive(image, filters), b = perceive(reference, filters);
    forAllPixels(map.pixelCount(), [&](size_t i) { map.pixels[i] = std::max(map.pixels[i], flipOf(a, b, i)); });
}

/// Colours in [0,1] for a display, three channels; `curve` maps each; `blackened` pixels are black.
template <typename Curve>
Bitmap displayed(const Bitmap& bitmap, const PixelMask& blackened, const Curve& curve) {
    Bitmap result(bitmap.width, bitmap.height, 3);
    const auto stride = static_cast<size_t>(bitmap.channels);
    forAllPixels(bitmap.pixelCount(), [&](size_t i) {
        for (size_t c = 0; c < 3; ++c) {
            const float value = bitmap.pixels[i * stride + (stride >= 3 ? c : 0)];
            result.pixels[3 * i + c] = blackened[i] != 0 ? 0.0f : std::clamp(curve(value), 0.0f, 1.0f);
        }
    });
    return result;
}

void setNaN(Bitmap& map, const PixelMask& where) {
    for (size_t i = 0; i < where.size(); ++i)
        if (where[i] != 0) map.pixels[i] = std::numeric_limits<float>::quiet_NaN();
}

void requirePixelsPerDegree(double value) {
    if (value >= kFlipLeastPixelsPerDegree && value <= kFlipMostPixelsPerDegree) return;
    throw Error(std::to_string(value) + " pixels per degree are out of range; give 1 to 1000, such as 67");
}

/// Narkowicz, "ACES Filmic Tone Mapping Curve", 2016: (p x^2 + q x) / (r x^2 + s x + t), with the factor of 0.6 on x
/// that HDR-FLIP undoes the curve's built-in exposure with.
struct AcesFit {
    double p = 0.6 * 0.6 * 2.51, q = 0.6 * 0.03, r = 0.6 * 0.6 * 2.43, s = 0.6 * 0.59, t = 0.14;

    float operator()(double linear) const {
        const double x = std::clamp(linear, 0.0, 1e6);  // saturated long before
        return static_cast<float>((p * x * x + q * x) / (r * x * x + s * x + t));
    }
    /// The x that is mapped to `value` in (0,1): the positive root of (p - r value) x^2 + (q - s value) x = t value.
    double inverse(double value) const {
        const double half = 0.5 * (q - s * value) / (p - r * value);
        return -half + std::sqrt(half * half + t * value / (p - r * value));
    }
};

/// Rec. 709 luminances of the pixels that are finite, ascending; negative values are black.
std::vector<double> sortedLuminances(const Bitmap& bitmap) {
    constexpr std::array<double, 3> kWeights = {0.2126, 0.7152, 0.0722};
    std::vector<double> luminances;
    for (int y = 0; y < bitmap.height; ++y)
        for (int x = 0; x < bitmap.width; ++x) {
            const float* pixel = bitmap.at(x, y);
            double luminance = 0.0;
            for (int c = 0; c < 3; ++c) {
                const double value = pixel[colorChannels(bitmap) == 3 ? c : 0];
                luminance += kWeights[static_cast<size_t>(c)] * (value < 0.0 ? 0.0 : value);
            }
            if (std::isfinite(luminance)) luminances.push_back(luminance);
        }
    std::ranges::sort(luminances);
    return luminances;
}

double medianOf(std::span<const double> sorted) {
    return 0.5 * (sorted[(sorted.size() - 1) / 2] + sorted[sorted.size() / 2]);
}

}  // namespace

Bitmap flipMap(const Bitmap& image, const Bitmap& reference, double pixelsPerDegree) {
    requireSameShape(image, reference);
    requirePixelsPerDegree(pixelsPerDegree);
    const PixelMask nonFinite = nonFinitePixels(image, reference);
    const auto asIs = [](float value) { return value; };
    Bitmap map(image.width, image.height, 1);
    raiseToFlip(map, displayed(image, nonFinite, asIs), displayed(reference, nonFinite, asIs),
                Filters(pixelsPerDegree));
    setNaN(map, nonFinite);
    return map;
}

FlipExposures hdrFlipExposures(const Bitmap& reference) {
    const std::vector<double> luminances = sortedLuminances(reference);
    if (luminances.empty() || luminances.back() <= 0.0) return {};
    const auto firstLit = std::ranges::upper_bound(luminances, 0.0);
    double median = medianOf(luminances);
    if (median <= 0.0) median = medianOf(std::span(firstLit, luminances.end()));
    const double bright = AcesFit{}.inverse(0.85);
    FlipExposures exposures;
    exposures.start = std::log2(bright / luminances.back());
    exposures.stop = std::log2(bright / median);
    const double stops = std::ceil(exposures.stop - exposures.start);
    exposures.count = static_cast<int>(std::clamp(stops, 2.0, double{kFlipMostExposures}));
    return exposures;
}

Bitmap hdrFlipMap(const Bitmap& image, const Bitmap& reference, const FlipExposures& exposures,
                  double pixelsPerDegree) {
    requireSameShape(image, reference);
    requirePixelsPerDegree(pixelsPerDegree);
    const PixelMask nonFinite = nonFinitePixels(image, reference);
    const Filters filters(pixelsPerDegree);
    const double step = (exposures.stop - exposures.start) / std::max(exposures.count - 1, 1);
    Bitmap map(image.width, image.height, 1);
    for (int i = 0; i < exposures.count; ++i) {
        const double scale = std::exp2(exposures.start + i * step);
        const auto toneMapped = [&](float value) { return AcesFit{}(scale * double{value}); };
        raiseToFlip(map, displayed(image, nonFinite, toneMapped), displayed(reference, nonFinite, toneMapped), filters);
    }
    setNaN(map, nonFinite);
    return map;
}

}  // namespace raylab
