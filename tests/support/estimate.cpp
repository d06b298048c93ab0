#include "tests/support/estimate.h"

#include <gtest/gtest.h>

#include <cmath>

namespace raylab::support {

Estimate estimateOf(const FilmImage& film, int channel) {
    Estimate estimate;
    double variance = 0.0;
    const size_t count = film.mean.pixelCount();
    for (size_t i = 0; i < count; ++i) {
        const size_t at = 3 * i + static_cast<size_t>(channel);
        estimate.mean += static_cast<double>(film.mean.pixels[at]);
        variance += static_cast<double>(film.variance.pixels[at]) / static_cast<double>(film.samples.pixels[i]);
    }
    estimate.mean /= static_cast<double>(count);
    estimate.standardError = std::sqrt(variance) / static_cast<double>(count);
    return estimate;
}

void expectExact(const FilmImage& film, double exact, const char* what) {
    const Estimate estimate = estimateOf(film);
    const double error = std::abs(estimate.mean - exact);
    const double scale = std::abs(exact);
    EXPECT_LE(error, 4.0 * estimate.standardError + 2e-5 * scale)
        << what << ": " << estimate.mean << " +- " << estimate.standardError << ", exactly " << exact;
    EXPECT_LE(error, 0.005 * scale) << what << ": " << estimate.mean << ", exactly " << exact;
    EXPECT_LE(estimate.standardError, 0.0025 * scale) << what << ": too few samples to tell";
    EXPECT_EQ(film.nonFinitePixels, 0u) << what;
}

void expectEveryPixel(const FilmImage& film, double exact, double relativeTolerance, const char* what) {
    size_t wrong = 0;
    double worst = 0.0;
    for (const float value : film.mean.pixels) {
        const double error = std::abs(static_cast<double>(value) - exact);
        worst = std::max(worst, error);
        if (!(error <= relativeTolerance * std::abs(exact))) ++wrong;
    }
    EXPECT_EQ(wrong, 0u) << what << ": of " << film.mean.pixels.size() << " values differ from " << exact
                         << ", by up to " << worst;
    EXPECT_EQ(film.nonFinitePixels, 0u) << what;
}

}  // namespace raylab::support
