#include "tests/support/estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace raylab::support {
namespace {

std::string caseName(const std::string& what) {
    const ::testing::TestInfo* const info = ::testing::UnitTest::GetInstance()->current_test_info();
    return std::string(info->test_suite_name()) + "." + info->name() + (what.empty() ? "" : ": " + what);
}

/// One row a case, of the channel that is furthest off: the number, its error, the exact value.
void printRow(const std::string& what, double number, double error, double exact) {
    std::printf("| %s | %.6g +- %.2g | %.6g |\n", caseName(what).c_str(), number, error, exact);
}

}  // namespace

void expectExact(const FilmImage& film, glm::dvec3 exact, const std::string& what) {
    const auto distance = [&](int channel) { return std::abs(estimateOf(film, channel).mean - exact[channel]); };
    int furthest = 0;
    for (int channel = 0; channel < 3; ++channel) {
        if (distance(channel) > distance(furthest)) furthest = channel;
        const Estimate estimate = estimateOf(film, channel);
        const double error = std::abs(estimate.mean - exact[channel]);
        const double scale = std::abs(exact[channel]);
        EXPECT_LE(error, 4.0 * estimate.standardError + 2e-5 * scale)
            << what << ": " << estimate.mean << " +- " << estimate.standardError << ", exactly " << exact[channel];
        EXPECT_LE(error, 0.005 * scale) << what << ": " << estimate.mean << ", exactly " << exact[channel];
        EXPECT_LE(estimate.standardError, 0.0025 * scale) << what << ": too few samples to tell";
    }
    EXPECT_EQ(film.nonFinitePixels, 0u) << what;
    const Estimate estimate = estimateOf(film, furthest);
    printRow(what, estimate.mean, estimate.standardError, exact[furthest]);
}

void expectExact(const FilmImage& film, double exact, const std::string& what) {
    expectExact(film, glm::dvec3(exact), what);
}

void expectEveryPixel(const FilmImage& film, glm::dvec3 exact, double relativeTolerance, const std::string& what) {
    int furthest = 0;
    double furthestOff = 0.0;
    for (int channel = 0; channel < 3; ++channel) {
        size_t wrong = 0;
        double worst = 0.0;
        for (size_t i = 0; i < film.mean.pixelCount(); ++i) {
            const float value = film.mean.pixels[3 * i + static_cast<size_t>(channel)];
            const double error = std::abs(static_cast<double>(value) - exact[channel]);
            worst = std::max(worst, error);
            if (!(error <= relativeTolerance * std::abs(exact[channel]))) ++wrong;
        }
        EXPECT_EQ(wrong, 0u) << what << ": of " << film.mean.pixelCount() << " pixels differ from " << exact[channel]
                             << ", by up to " << worst;
        if (worst > furthestOff) furthest = channel;
        furthestOff = std::max(furthestOff, worst);
    }
    EXPECT_EQ(film.nonFinitePixels, 0u) << what;
    printRow(what, estimateOf(film, furthest).mean, furthestOff, exact[furthest]);
}

void expectEveryPixel(const FilmImage& film, double exact, double relativeTolerance, const std::string& what) {
    expectEveryPixel(film, glm::dvec3(exact), relativeTolerance, what);
}

size_t countDifferent(const Bitmap& a, const Bitmap& b, float relativeTolerance) {
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    size_t different = 0;
    for (size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i)
        if (!(std::abs(a.pixels[i] - b.pixels[i]) <= relativeTolerance * std::abs(b.pixels[i]))) ++different;
    return different;
}

}  // namespace raylab::support
