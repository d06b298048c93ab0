#include "engine/measure/image_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "engine/core/error.h"
#include "engine/image/srgb.h"

namespace raylab {
namespace {

using Rgb = std::array<float, 3>;

/// sRGB-encoded, evenly spaced: CIE lightness 0, 20, 39, 57, 78 and 99.
constexpr std::array<Rgb, 6> kHeatRamp = {{{0.000f, 0.000f, 0.000f},
                                           {0.275f, 0.059f, 0.471f},
                                           {0.647f, 0.157f, 0.412f},
                                           {0.902f, 0.373f, 0.176f},
                                           {0.980f, 0.706f, 0.196f},
                                           {1.000f, 1.000f, 0.863f}}};
constexpr Rgb kHeatNoNumber = {0.0f, 1.0f, 1.0f};
constexpr Rgb kHeatLeftOut = {0.2f, 0.2f, 0.2f};

std::string describe(const Bitmap& bitmap) {
    return std::to_string(bitmap.width) + " x " + std::to_string(bitmap.height) +
           (colorChannels(bitmap) == 3 ? " (colour)" : " (grey)");
}

/// Linear RGB of a position in [0,1] on the ramp; outside it is clamped.
Rgb rampColor(double wanted) {
    const double position = std::clamp(wanted, 0.0, 1.0) * (kHeatRamp.size() - 1);
    const size_t segment = std::min(static_cast<size_t>(position), kHeatRamp.size() - 2);
    const float t = static_cast<float>(position - static_cast<double>(segment));
    Rgb color{};
    for (size_t c = 0; c < 3; ++c)
        color[c] = srgbToLinear(std::lerp(kHeatRamp[segment][c], kHeatRamp[segment + 1][c], t));
    return color;
}

}  // namespace

int colorChannels(const Bitmap& bitmap) { return bitmap.channels >= 3 ? 3 : 1; }

void requireSameShape(const Bitmap& image, const Bitmap& reference) {
    const bool same = image.width == reference.width && image.height == reference.height &&
                      colorChannels(image) == colorChannels(reference);
    if (!same)
        throw Error("the images cannot be compared: " + describe(image) + " pixels against " + describe(reference) +
                    "; give two of the same size");
}

PixelMask maskOf(const Bitmap& picture) {
    const int channels = colorChannels(picture);
    PixelMask mask;
    mask.reserve(picture.pixelCount());
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const float* pixel = picture.at(x, y);
            mask.push_back(std::any_of(pixel, pixel + channels, [](float value) { return value != 0.0f; }));
        }
    return mask;
}

void requireMaskFits(std::span<const uint8_t> mask, const Bitmap& bitmap) {
    if (!mask.empty() && mask.size() != bitmap.pixelCount())
        throw Error("a mask of " + std::to_string(mask.size()) + " pixels does not fit an image of " +
                    describe(bitmap) + "; give one of the same size");
}

bool isFinite(const float* pixel, int channels) {
    return std::all_of(pixel, pixel + channels, [](float value) { return std::isfinite(value); });
}

PixelMask nonFinitePixels(const Bitmap& image, const Bitmap& reference) {
    const int channels = colorChannels(image);
    PixelMask found;
    found.reserve(image.pixelCount());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            found.push_back(!isFinite(image.at(x, y), channels) || !isFinite(reference.at(x, y), channels));
    return found;
}

Bitmap cropped(const Bitmap& bitmap, const PixelRect& rect) {
    const std::string text = std::to_string(rect.width) + " x " + std::to_string(rect.height) + " pixels at " +
                             std::to_string(rect.x) + "," + std::to_string(rect.y);
    if (rect.width < 1 || rect.height < 1)
        throw Error("a crop of " + text + " is empty; give a width and a height of at least 1");
    if (rect.x < 0 || rect.y < 0 || rect.width > bitmap.width - rect.x || rect.height > bitmap.height - rect.y)
        throw Error("a crop of " + text + " reaches beyond the image of " + describe(bitmap) + "; give one inside");
    Bitmap part(rect.width, rect.height, bitmap.channels);
    for (int y = 0; y < rect.height; ++y)
        std::copy_n(bitmap.at(rect.x, rect.y + y), static_cast<size_t>(rect.width) * bitmap.channels, part.at(0, y));
    return part;
}

double meanOf(const Bitmap& map, std::span<const uint8_t> mask) {
    requireMaskFits(mask, map);
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < map.pixels.size(); ++i) {
        if ((!mask.empty() && mask[i] == 0) || std::isnan(map.pixels[i])) continue;
        sum += double{map.pixels[i]};
        ++count;
    }
    return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

Bitmap heatPicture(const Bitmap& map, double lowest, double highest, std::span<const uint8_t> mask) {
    requireMaskFits(mask, map);
    Bitmap picture(map.width, map.height, 3);
    for (size_t i = 0; i < map.pixels.size(); ++i) {
        const double value = map.pixels[i];
        Rgb color = kHeatLeftOut;
        if (mask.empty() || mask[i] != 0)
            color = std::isnan(value) ? kHeatNoNumber : rampColor((value - lowest) / (highest - lowest));
        std::ranges::copy(color, picture.pixels.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return picture;
}

}  // namespace raylab
