#include "engine/measure/plane_filter.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace raylab {
namespace {

constexpr int kRowsPerTask = 16;
using RowRange = tbb::blocked_range<int>;

template <typename T>
void addScaled(T* sums, const T* values, T scale, int count) {
    for (int x = 0; x < count; ++x) sums[x] += scale * values[x];
}

template <typename T>
Plane<T> filterRows(const Plane<T>& input, std::span<const T> taps) {
    const int radius = static_cast<int>(taps.size() / 2);
    Plane<T> output(input.width, input.height);
    tbb::parallel_for(RowRange(0, input.height, kRowsPerTask), [&](const RowRange& rows) {
        std::vector<T> padded(static_cast<size_t>(input.width) + taps.size() - 1);
        for (int y = rows.begin(); y != rows.end(); ++y) {
            const T* values = input.row(y);
            std::fill_n(padded.begin(), radius, values[0]);
            std::copy_n(values, input.width, padded.begin() + radius);
            std::fill_n(padded.end() - radius, radius, values[input.width - 1]);
            for (size_t tap = 0; tap < taps.size(); ++tap)
                addScaled(output.row(y), padded.data() + tap, taps[tap], input.width);
        }
    });
    return output;
}

template <typename T>
Plane<T> filterColumns(const Plane<T>& input, std::span<const T> taps) {
    const int radius = static_cast<int>(taps.size() / 2);
    Plane<T> output(input.width, input.height);
    tbb::parallel_for(RowRange(0, input.height, kRowsPerTask), [&](const RowRange& rows) {
        for (int y = rows.begin(); y != rows.end(); ++y)
            for (int tap = 0; tap < static_cast<int>(taps.size()); ++tap) {
                const int source = std::clamp(y + tap - radius, 0, input.height - 1);
                addScaled(output.row(y), input.row(source), taps[static_cast<size_t>(tap)], input.width);
            }
    });
    return output;
}

}  // namespace

std::vector<double> gaussianTaps(double sigma, int radius) {
    std::vector<double> taps;
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        taps.push_back(std::exp(-0.5 * x * x / (sigma * sigma)));
        sum += taps.back();
    }
    for (double& tap : taps) tap /= sum;
    return taps;
}

template <typename T>
Plane<T> filterSeparable(const Plane<T>& input, std::span<const T> rowTaps, std::span<const T> columnTaps) {
    if (input.values.empty()) return {input.width, input.height};
    return filterColumns(filterRows(input, rowTaps), columnTaps);
}

template Plane<float> filterSeparable(const Plane<float>&, std::span<const float>, std::span<const float>);
template Plane<double> filterSeparable(const Plane<double>&, std::span<const double>, std::span<const double>);

}  // namespace raylab
