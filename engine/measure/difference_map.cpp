#include "engine/measure/difference_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/measure/image_error.h"
#include "engine/measure/image_pair.h"

namespace raylab {
namespace {

/// `ofPixel` of the x, y of each pixel.
template <class OfPixel>
Bitmap mapOf(const Bitmap& a, const Bitmap& b, const OfPixel& ofPixel) {
    requireSameShape(a, b);
    Bitmap map(a.width, a.height, 1);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) *map.at(x, y) = static_cast<float>(ofPixel(x, y));
    return map;
}

/// Of the mean of a pixel's samples.
double varianceOfMean(const FilmImage& film, int x, int y, int channel) {
    const double samples = static_cast<double>(*film.samples.at(x, y));
    return samples > 0.0 ? static_cast<double>(film.variance.at(x, y)[channel]) / samples : 0.0;
}

}  // namespace

Bitmap absoluteDifference(const Bitmap& a, const Bitmap& b) {
    const int channels = colorChannels(a);
    return mapOf(a, b, [&](int x, int y) {
        double sum = 0.0;
        for (int c = 0; c < channels; ++c)
            sum += std::abs(static_cast<double>(a.at(x, y)[c]) - static_cast<double>(b.at(x, y)[c]));
        return sum / channels;
    });
}

Bitmap relativeDifference(const Bitmap& a, const Bitmap& b) {
    const int channels = colorChannels(a);
    return mapOf(a, b, [&](int x, int y) {
        double sum = 0.0;
        for (int c = 0; c < channels; ++c) {
            const auto va = static_cast<double>(a.at(x, y)[c]), vb = static_cast<double>(b.at(x, y)[c]);
            sum += (va - vb) * (va - vb) / (vb * vb + kRelMseEpsilon);
        }
        return std::sqrt(sum / channels);
    });
}

Bitmap zScores(const FilmImage& a, const FilmImage& b) {
    const int channels = colorChannels(a.mean);
    return mapOf(a.mean, b.mean, [&](int x, int y) {
        double largest = 0.0;
        for (int c = 0; c < channels; ++c) {
            const double difference =
                std::abs(static_cast<double>(a.mean.at(x, y)[c]) - static_cast<double>(b.mean.at(x, y)[c]));
            if (difference == 0.0) continue;
            const double variance = varianceOfMean(a, x, y, c) + varianceOfMean(b, x, y, c);
            const double z =
                variance > 0.0 ? difference / std::sqrt(variance) : std::numeric_limits<double>::infinity();
            largest = std::max(largest, z);
        }
        return largest;
    });
}

double relativeNoise(const FilmImage& film) {
    const int channels = colorChannels(film.mean);
    double sum = 0.0;
    for (int y = 0; y < film.mean.height; ++y)
        for (int x = 0; x < film.mean.width; ++x)
            for (int c = 0; c < channels; ++c) {
                const auto mean = static_cast<double>(film.mean.at(x, y)[c]);
                sum += varianceOfMean(film, x, y, c) / (mean * mean + kRelMseEpsilon);
            }
    return std::sqrt(sum / (static_cast<double>(film.mean.pixelCount()) * channels));
}

}  // namespace raylab
