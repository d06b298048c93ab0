#include "ui/editor/model/color_map.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace raylab::editor {
namespace {

/// Lightness 0 .. 1, chroma, and hue in degrees, of Oklab.
struct Lch {
    double lightness, chroma, hue;
};

double encodeSrgb(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

/// Ottosson's matrices from Oklab to linear sRGB.
glm::dvec3 linearOf(const Lch& color) {
    const double angle = glm::radians(color.hue), a = color.chroma * std::cos(angle),
                 b = color.chroma * std::sin(angle);
    const double l = std::pow(color.lightness + 0.3963377774 * a + 0.2158037573 * b, 3.0);
    const double m = std::pow(color.lightness - 0.1055613458 * a - 0.0638541728 * b, 3.0);
    const double s = std::pow(color.lightness - 0.0894841775 * a - 1.2914855480 * b, 3.0);
    return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
            -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
            -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool isShowable(const glm::dvec3& c) { return std::min({c.x, c.y, c.z}) >= 0.0 && std::max({c.x, c.y, c.z}) <= 1.0; }

/// With as much of its chroma as a display has at that lightness: so the lightness is kept.
glm::vec3 display(Lch color) {
    double lo = 0.0, hi = 1.0;
    if (isShowable(linearOf(color))) lo = 1.0;
    for (int i = 0; i < 12 && lo < 1.0; ++i) {
        const double middle = 0.5 * (lo + hi);
        (isShowable(linearOf({color.lightness, middle * color.chroma, color.hue})) ? lo : hi) = middle;
    }
    color.chroma *= lo;
    const glm::dvec3 linear = linearOf(color);
    return {encodeSrgb(linear.x), encodeSrgb(linear.y), encodeSrgb(linear.z)};
}

}  // namespace

glm::vec3 mapColor(ColorMap map, double value) {
    const double v = std::isnan(value) ? 0.0 : std::clamp(value, 0.0, 1.0);
    switch (map) {
        case ColorMap::heat:
            return display(
                {0.12 + 0.86 * v, 0.21 * std::sin(glm::pi<double>() * (0.12 + 0.78 * v)), -50.0 + 150.0 * v});
        case ColorMap::sequential:
            return display({0.25 + 0.68 * v, 0.15, 280.0 - 175.0 * v});
        case ColorMap::diverging: {
            const double away = std::abs(2.0 * v - 1.0);
            return display({0.93 - 0.48 * away, 0.19 * away, v < 0.5 ? 255.0 : 27.0});
        }
        case ColorMap::grey:
            return display({0.15 + 0.85 * v, 0.0, 0.0});
    }
    return glm::vec3(0.0f);
}

glm::vec3 categoryColor(uint32_t index) {
    constexpr double kGoldenAngle = 137.50776405003785;
    return display({0.76, 0.14, std::fmod(30.0 + kGoldenAngle * index, 360.0)});
}

uint32_t packColor(const glm::vec3& color) {
    const auto byte = [](float v) { return static_cast<uint32_t>(std::lround(255.0f * std::clamp(v, 0.0f, 1.0f))); };
    return byte(color.x) | byte(color.y) << 8 | byte(color.z) << 16 | 0xff000000u;
}

}  // namespace raylab::editor
