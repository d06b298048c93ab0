#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace raylab {

/// One value a pixel, rows from top to bottom.
template <typename T>
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<T> values;

    Plane(int width_, int height_)
        : width(width_), height(height_), values(static_cast<size_t>(width_) * static_cast<size_t>(height_)) {}

    T* row(int y) { return values.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
    const T* row(int y) const { return values.data() + static_cast<size_t>(y) * static_cast<size_t>(width); }
};

/// exp(-x^2 / (2 sigma^2)) at x = -radius .. radius, divided by its sum.
std::vector<double> gaussianTaps(double sigma, int radius);

/// Correlation with the separable filter rowTaps(x) columnTaps(y): an odd number of taps each, centre in the middle.
/// Beyond the border the nearest pixel is repeated. For T = float and double; the same result on any number of threads.
template <typename T>
Plane<T> filterSeparable(const Plane<T>& input, std::span<const T> rowTaps, std::span<const T> columnTaps);

}  // namespace raylab
