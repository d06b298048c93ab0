#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "engine/image/bitmap.h"

/// LDR-FLIP as sections 4.1 to 4.3 of its paper write it down: double precision, filters of two dimensions, YCxCz with
/// its scales and offset, primaries from their chromaticities. Slow, and shares nothing with the engine.
namespace raylab::flipdirect {

using Color = std::array<double, 3>;
using Image = std::vector<Color>;

/// Cramer's rule; the columns of the matrix are a, b and c.
inline Color solve(const Color& a, const Color& b, const Color& c, const Color& right) {
    const auto determinant = [](const Color& p, const Color& q, const Color& r) {
        return p[0] * (q[1] * r[2] - q[2] * r[1]) - q[0] * (p[1] * r[2] - p[2] * r[1]) +
               r[0] * (p[1] * q[2] - p[2] * q[1]);
    };
    const double whole = determinant(a, b, c);
    return {determinant(right, b, c) / whole, determinant(a, right, c) / whole, determinant(a, b, right) / whole};
}

inline Color fromChromaticity(double x, double y) { return {x / y, 1.0, (1.0 - x - y) / y}; }

struct Primaries {
    Color white = fromChromaticity(0.3127, 0.3290);  // D65
    Color red = fromChromaticity(0.64, 0.33);
    Color green = fromChromaticity(0.30, 0.60);
    Color blue = fromChromaticity(0.15, 0.06);

    Primaries() {
        const Color luminances = solve(red, green, blue, white);
        for (double& component : red) component *= luminances[0];
        for (double& component : green) component *= luminances[1];
        for (double& component : blue) component *= luminances[2];
    }
};

inline const Primaries kPrimaries;

template <typename Rgb>
Color xyzOf(const Rgb& rgb) {
    Color xyz{};
    for (size_t i = 0; i < 3; ++i)
        xyz[i] = double{rgb[0]} * kPrimaries.red[i] + double{rgb[1]} * kPrimaries.green[i] +
                 double{rgb[2]} * kPrimaries.blue[i];
    return xyz;
}

inline Color huntLab(const Color& xyz) {
    const auto f = [&](size_t i) {
        const double t = xyz[i] / kPrimaries.white[i];
        return t > std::pow(6.0 / 29.0, 3.0) ? std::cbrt(t) : t * 841.0 / 108.0 + 4.0 / 29.0;
    };
    const double lightness = 116.0 * f(1) - 16.0;
    return {lightness, 5.0 * lightness * (f(0) - f(1)), 2.0 * lightness * (f(1) - f(2))};
}

inline double colorError(const Color& a, const Color& b) {
    const auto power = [](const Color& p, const Color& q) {
        return std::pow(std::abs(p[0] - q[0]) + std::sqrt(std::pow(p[1] - q[1], 2) + std::pow(p[2] - q[2], 2)), 0.7);
    };
    const double largest = power(huntLab(kPrimaries.green), huntLab(kPrimaries.blue));
    const double error = power(a, b), knee = 0.4 * largest;
    return error < knee ? 0.95 * error / knee : 0.95 + 0.05 * (error - knee) / (largest - knee);
}

struct Picture {
    int width = 0;
    int height = 0;
    std::array<std::vector<double>, 3> ycxcz;

    explicit Picture(const Bitmap& bitmap) : width(bitmap.width), height(bitmap.height) {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                Color rgb{};
                for (int c = 0; c < 3; ++c)
                    rgb[static_cast<size_t>(c)] = std::clamp(double{bitmap.at(x, y)[c]}, 0.0, 1.0);
                const Color xyz = xyzOf(rgb);
                const double relativeX = xyz[0] / kPrimaries.white[0], relativeZ = xyz[2] / kPrimaries.white[2];
                ycxcz[0].push_back(116.0 * xyz[1] - 16.0);
                ycxcz[1].push_back(500.0 * (relativeX - xyz[1]));
                ycxcz[2].push_back(200.0 * (xyz[1] - relativeZ));
            }
    }

    /// Sum of weight(dx, dy) times the channel around a pixel, the border repeated.
    double around(size_t channel, int x, int y, int radius, const std::function<double(int, int)>& weight) const {
        double sum = 0.0;
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx) {
                const int row = std::clamp(y + dy, 0, height - 1), column = std::clamp(x + dx, 0, width - 1);
                sum += weight(dx, dy) * ycxcz[channel][static_cast<size_t>(row * width + column)];
            }
        return sum;
    }
};

/// A function on a square of pixels, tabulated.
class Table {
public:
    Table(int radius, const std::function<double(int, int)>& value) : radius_(radius) {
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x) values_.push_back(value(x, y));
    }
    double operator()(int x, int y) const {
        return values_[static_cast<size_t>((y + radius_) * (2 * radius_ + 1) + x + radius_)];
    }
    void scale(const std::function<double(double)>& by) {
        for (double& value : values_) value *= by(value);
    }
    double sum(const std::function<bool(double)>& counts) const {
        double total = 0.0;
        for (const double value : values_) total += counts(value) ? value : 0.0;
        return total;
    }

private:
    int radius_;
    std::vector<double> values_;
};

inline Table contrastSensitivity(int radius, double pixelsPerDegree, double a1, double b1, double a2, double b2) {
    Table table(radius, [=](int x, int y) {
        const double squaredDegrees = (x * x + y * y) / (pixelsPerDegree * pixelsPerDegree);
        const auto term = [&](double a, double b) {
            return a * std::sqrt(std::numbers::pi / b) * std::exp(-std::pow(std::numbers::pi, 2) * squaredDegrees / b);
        };
        return term(a1, b1) + term(a2, b2);
    });
    const double total = table.sum([](double) { return true; });
    table.scale([=](double) { return 1.0 / total; });
    return table;
}

inline Table detector(int radius, const std::function<double(int, int)>& value) {
    Table table(radius, value);
    const double positive = table.sum([](double v) { return v > 0.0; });
    const double negative = table.sum([](double v) { return v < 0.0; });
    table.scale([=](double v) { return 1.0 / (v > 0.0 ? positive : -negative); });
    return table;
}

struct Observer {
    int colorRadius, featureRadius;
    std::array<Table, 3> colorFilters;
    Table edge, point;

    explicit Observer(double ppd)
        : colorRadius(static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * std::pow(std::numbers::pi, 2))) * ppd))),
          featureRadius(static_cast<int>(std::ceil(1.5 * 0.082 * ppd))),
          colorFilters{contrastSensitivity(colorRadius, ppd, 1.0, 0.0047, 0.0, 1e-5),
                       contrastSensitivity(colorRadius, ppd, 1.0, 0.0053, 0.0, 1e-5),
                       contrastSensitivity(colorRadius, ppd, 34.1, 0.04, 13.5, 0.025)},
          edge(detector(featureRadius, [=](int x, int y) { return -x * gaussian(x, y, ppd); })),
          point(detector(featureRadius, [=](int x, int y) {
              return (x * x / std::pow(0.041 * ppd, 2) - 1.0) * gaussian(x, y, ppd);
          })) {}

    static double gaussian(int x, int y, double ppd) {
        return std::exp(-(x * x + y * y) / (2.0 * std::pow(0.041 * ppd, 2)));
    }

    Color seen(const Picture& picture, int x, int y) const {
        Color ycxcz{};
        for (size_t c = 0; c < 3; ++c)
            ycxcz[c] = picture.around(c, x, y, colorRadius, [&](int dx, int dy) { return colorFilters[c](dx, dy); });
        const double luminance = (ycxcz[0] + 16.0) / 116.0;
        const Color xyz = {(luminance + ycxcz[1] / 500.0) * kPrimaries.white[0], luminance,
                           (luminance - ycxcz[2] / 200.0) * kPrimaries.white[2]};
        Color rgb = solve(kPrimaries.red, kPrimaries.green, kPrimaries.blue, xyz);
        for (double& channel : rgb) channel = std::clamp(channel, 0.0, 1.0);
        return huntLab(xyzOf(rgb));
    }

    /// Length of a detector's answers along x and y; it sums to 0, so the offset of the luminance has no say.
    double strength(const Picture& picture, const Table& table, int x, int y) const {
        const double alongX =
            picture.around(0, x, y, featureRadius, [&](int dx, int dy) { return table(dx, dy) / 116.0; });
        const double alongY =
            picture.around(0, x, y, featureRadius, [&](int dx, int dy) { return table(dy, dx) / 116.0; });
        return std::sqrt(alongX * alongX + alongY * alongY);
    }
};

inline std::vector<double> flip(const Bitmap& image, const Bitmap& reference, double pixelsPerDegree) {
    const Observer observer(pixelsPerDegree);
    const Picture a(image), b(reference);
    std::vector<double> map;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto differenceOf = [&](const Table& table) {
                return std::abs(observer.strength(a, table, x, y) - observer.strength(b, table, x, y));
            };
            const double feature =
                std::sqrt(std::max(differenceOf(observer.edge), differenceOf(observer.point)) / std::numbers::sqrt2);
            map.push_back(std::pow(colorError(observer.seen(a, x, y), observer.seen(b, x, y)), 1.0 - feature));
        }
    return map;
}

}  // namespace raylab::flipdirect
