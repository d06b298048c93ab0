#include <algorithm>
#include <cmath>

#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

/// Two-float sums of a million samples, made here in long double.
shared::FilmPixel pixelOfSums(long double sum, long double square, uint32_t count) {
    shared::FilmPixel pixel{};
    const auto split = [](long double value, float& hi, float& lo) {
        hi = static_cast<float>(value);
        lo = static_cast<float>(value - static_cast<long double>(hi));
    };
    for (int c = 0; c < 3; ++c) {
        split(sum, pixel.sumHi[c], pixel.sumLo[c]);
        split(square, pixel.squareHi[c], pixel.squareLo[c]);
    }
    pixel.count = count;
    return pixel;
}

/// The deviation is a thousandth of the mean: in single precision nothing of the variance would be left.
TEST(FilmDevelop, MillionSamplesKeepTheirPrecision) {
    constexpr uint32_t kCount = 1000000;
    accel_test::Random random(71);
    std::vector<float> samples(kCount);
    long double sum = 0.0L, square = 0.0L;
    for (float& sample : samples) {
        sample = 10.0f + random.uniform(-0.01f, 0.01f);
        sum += static_cast<long double>(sample);
        square += static_cast<long double>(sample) * static_cast<long double>(sample);
    }
    const long double mean = sum / kCount;
    long double spread = 0.0L;
    for (const float sample : samples)
        spread += (static_cast<long double>(sample) - mean) * (static_cast<long double>(sample) - mean);
    const auto variance = static_cast<double>(spread / (kCount - 1));
    const FilmImage film = developFilm({pixelOfSums(sum, square, kCount)}, 1, 1);
    EXPECT_FLOAT_EQ(film.mean.pixels[0], static_cast<float>(mean));
    EXPECT_NEAR(static_cast<double>(film.variance.pixels[0]), variance, 1e-4 * variance);
    EXPECT_EQ(film.samples.pixels[0], static_cast<float>(kCount));
    const double relative = std::sqrt(variance / kCount) / std::sqrt(static_cast<double>(mean * mean) + 1e-2);
    EXPECT_NEAR(film.estimatedRelativeError, relative, 1e-4 * relative);
}

TEST(FilmDevelop, PixelsWithoutSamplesAreBlack) {
    shared::FilmPixel spoilt{};
    spoilt.nonFinite = 3;
    const FilmImage film = developFilm({shared::FilmPixel{}, spoilt}, 2, 1);
    for (const float value : film.mean.pixels) EXPECT_EQ(value, 0.0f);
    EXPECT_EQ(film.nonFinitePixels, 1u);
    EXPECT_TRUE(std::isfinite(film.estimatedRelativeError));
}

using FilmOnDevice = GpuTest;

std::pair<float, float> extremes(const Bitmap& bitmap) {
    const auto [lo, hi] = std::minmax_element(bitmap.pixels.begin(), bitmap.pixels.end());
    return {*lo, *hi};
}

/// 0.1 is no sum of a few powers of two: adding it 65536 times in single precision would be off in the fourth digit.
TEST_F(FilmOnDevice, ConstantRadianceHasNoError) {
    Scene scene;
    scene.environment = constantEnvironment(0.1f);
    lookAt(scene, {0.0f, 0.0f, 1.0f}, glm::vec3(0.0f), 1.0f);
    const FilmImage film = renderFilm(device_, scene, smallImage(8, 65536, 1));
    EXPECT_EQ(extremes(film.mean), std::pair(0.1f, 0.1f));
    EXPECT_LE(extremes(film.variance).second, 1e-13f);
    EXPECT_EQ(extremes(film.samples), std::pair(65536.0f, 65536.0f));
    EXPECT_EQ(film.rays, 64u * 65536u);
}

TEST_F(FilmOnDevice, WhiteHasNoVarianceAtAll) {
    Scene scene;
    lookAt(scene, {0.0f, 0.0f, 1.0f}, glm::vec3(0.0f), 1.0f);
    RenderSettings settings = smallImage(8, 4096, 1);
    settings.environment = "white";
    const FilmImage film = renderFilm(device_, scene, settings);
    EXPECT_EQ(extremes(film.mean), std::pair(1.0f, 1.0f));
    EXPECT_EQ(extremes(film.variance), std::pair(0.0f, 0.0f));
}

/// Half of each sample's pixels are black, half white: the variance of a coin, p (1 - p) n / (n - 1).
TEST_F(FilmOnDevice, VarianceOfACoin) {
    Scene scene;
    Material coin = lambert(0.0f);
    coin.alphaMode = AlphaMode::blend;
    coin.alpha = 0.5f;
    addMesh(scene, floorQuad(addMaterial(scene, coin), 5.0f));
    scene.environment = constantEnvironment(1.0f);
    lookDown(scene, 1.0f);
    const FilmImage film = renderFilm(device_, scene, smallImage(8, 4096, 1));
    for (size_t i = 0; i < film.mean.pixels.size(); i += 3) {
        const auto p = static_cast<double>(film.mean.pixels[i]);
        EXPECT_NEAR(p, 0.5, 4.0 * std::sqrt(0.25 / 4096.0)) << "4 standard errors";
        EXPECT_NEAR(static_cast<double>(film.variance.pixels[i]), p * (1.0 - p) * 4096.0 / 4095.0, 1e-6);
    }
}

}  // namespace
}  // namespace raylab::support
