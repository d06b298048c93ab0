#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/core/error.h"
#include "engine/measure/difference_map.h"
#include "engine/measure/image_error.h"

namespace raylab {
namespace {

/// A film of `samples` normal samples a pixel and channel.
FilmImage normalFilm(int width, int height, int samples, double mean, double deviation, uint32_t seed) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal(mean, deviation);
    FilmImage film;
    film.mean = Bitmap(width, height, 3);
    film.variance = Bitmap(width, height, 3);
    film.samples = Bitmap(width, height, 1);
    for (float& count : film.samples.pixels) count = static_cast<float>(samples);
    for (size_t i = 0; i < film.mean.pixels.size(); ++i) {
        double sum = 0.0;
        for (int s = 0; s < samples; ++s) sum += normal(engine);
        film.mean.pixels[i] = static_cast<float>(sum / samples);
        film.variance.pixels[i] = static_cast<float>(deviation * deviation);
    }
    return film;
}

TEST(DifferenceMap, IsWhatItsFormulasSay) {
    FilmImage a = normalFilm(1, 1, 4, 0.0, 0.0, 1), b = a;
    a.mean.pixels = {1.0f, 2.0f, 0.5f};
    b.mean.pixels = {0.5f, 2.0f, 0.75f};
    EXPECT_FLOAT_EQ(absoluteDifference(a.mean, b.mean).pixels[0], 0.25f);
    const double relative = std::sqrt((0.25 / 0.26 + 0.0 + 0.0625 / 0.5725) / 3.0);
    EXPECT_NEAR(static_cast<double>(relativeDifference(a.mean, b.mean).pixels[0]), relative, 1e-6);
    EXPECT_TRUE(std::isinf(zScores(a, b).pixels[0])) << "neither has a variance";
    EXPECT_EQ(zScores(a, a).pixels[0], 0.0f);
    a.variance.pixels = {0.04f, 1.0f, 0.25f};  // of four samples: 0.01, 0.25, 0.0625
    EXPECT_NEAR(static_cast<double>(zScores(a, b).pixels[0]), 5.0, 1e-5);
    EXPECT_THROW(absoluteDifference(a.mean, Bitmap(2, 1, 3)), Error);
}

/// The largest of three standard normal variables exceeds 3 in size with probability 1 - (1 - 0.0026998)^3.
TEST(DifferenceMap, ScoresOfEqualEstimatorsAreNormal) {
    const FilmImage a = normalFilm(300, 200, 4, 0.7, 0.3, 20261123), b = normalFilm(300, 200, 4, 0.7, 0.3, 20261124);
    size_t large = 0;
    for (const float z : zScores(a, b).pixels) large += z > 3.0f ? 1 : 0;
    const double n = 300.0 * 200.0, p = 1.0 - std::pow(1.0 - 0.0026998, 3.0);
    EXPECT_NEAR(static_cast<double>(large) / n, p, 4.0 * std::sqrt(p / n)) << "seeds 20261123, 20261124";
}

/// deviation / sqrt(samples) over sqrt(mean^2 + 0.01).
TEST(DifferenceMap, NoiseIsTheErrorAgainstTheTruth) {
    const FilmImage film = normalFilm(300, 200, 16, 1.0, 0.1, 20261126);
    const double wanted = 0.025 / std::sqrt(1.01);
    EXPECT_NEAR(relativeNoise(film), wanted, 0.005 * wanted);
    Bitmap truth(300, 200, 3);
    for (float& value : truth.pixels) value = 1.0f;
    const double measured = std::sqrt(compareImages(film.mean, truth).relMse);
    // The root of a mean of n squares of normal variables has the relative error sqrt(1 / (2 n)).
    EXPECT_NEAR(relativeNoise(film), measured, 0.005 * wanted + 4.0 * wanted * std::sqrt(0.5 / (3.0 * 300.0 * 200.0)));
}

}  // namespace
}  // namespace raylab
