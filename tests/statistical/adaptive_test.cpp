#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "engine/core/error.h"
#include "engine/render/adaptive.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// Samples where the noise is.
namespace raylab::support {
namespace {

using Adaptive = GpuTest;

constexpr double kAlbedo = 0.6;

double meanSamples(const FilmImage& film) {
    return std::accumulate(film.samples.pixels.begin(), film.samples.pixels.end(), 0.0) /
           static_cast<double>(film.samples.pixelCount());
}

/// A Lambertian floor under lamps of unlike power that are chosen evenly: noisy, with a long tail. A5 twice over.
Scene unlikeLamps() {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(static_cast<float>(kAlbedo))), 3.0f));
    const float radiance[2] = {20.0f, 0.2f};
    for (int i = 0; i < 2; ++i) {
        const float z = 0.5f * static_cast<float>(i);
        addMesh(scene, quad(addMaterial(scene, lamp(radiance[i])), {-0.5f, 1, z - 0.5f}, {0.5f, 1, z - 0.5f},
                            {0.5f, 1, z}, {-0.5f, 1, z}));
    }
    return scene;
}

/// Every pixel estimates the same number from few samples, so that blocks whose pilot happens to be quiet get fewer.
/// Would the pilot's samples stay in the film, what it missed would be missed for good.
TEST_F(Adaptive, IsUnbiased) {
    Scene scene = unlikeLamps();
    lookAtPoint(scene, {3.0f, 0.4f, 1.0f}, glm::vec3(0.0f));
    RenderSettings settings = smallImage(96, 12, 1);
    settings.lightChoice = "uniform";
    settings.sampler = "independent";
    settings.adaptive = true;
    const double exact = kAlbedo / kPi * 0.752275 * 0.5 * (20.0 + 0.2);
    constexpr int kSeeds = 4;
    double mean = 0.0, squaredError = 0.0;
    for (int seed = 0; seed < kSeeds; ++seed) {
        settings.seed = 1000 + seed;
        const FilmImage film = renderFilm(device_, scene, settings);
        const Estimate estimate = estimateOf(film);
        mean += estimate.mean / kSeeds;
        squaredError += estimate.standardError * estimate.standardError / (kSeeds * kSeeds);
        const auto [least, most] = std::ranges::minmax(film.samples.pixels);
        EXPECT_GE(most, 1.25f * least) << "samples did not go by the noise";
    }
    const double error = std::sqrt(squaredError);
    std::printf("%.5f +- %.5f, exactly %.5f\n", mean, error, exact);
    EXPECT_LE(std::abs(mean - exact), 4.0 * error);
    EXPECT_LE(error, 0.0025 * exact) << "too few samples to tell";
}

/// Half of the picture is a lamp without noise. From as many samples in all, the pilot's among them, the error is
/// smaller.
TEST_F(Adaptive, HasLessErrorWhereNoiseIsUneven) {
    Scene scene = unlikeLamps();
    addMesh(scene, quad(addMaterial(scene, lamp(0.3f)), {-0.5f, 0.1f, 0.5f}, {0.25f, 0.1f, 0.5f}, {0.25f, 0.1f, -0.5f},
                        {-0.5f, 0.1f, -0.5f}));
    lookAt(scene, {0.0f, 0.9f, 0.0f}, glm::vec3(0.0f), 1.0f);
    scene.cameras[0].up = {0, 0, -1};
    RenderSettings settings = smallImage(32, 4096, 1);
    const FilmImage reference = renderFilm(device_, scene, settings);
    settings.spp = 64;
    double errors[2] = {};
    for (int adaptive = 0; adaptive < 2; ++adaptive) {
        settings.adaptive = adaptive == 1;
        double samples = 0.0;
        constexpr int kSeeds = 2;
        for (int seed = 0; seed < kSeeds; ++seed) {
            settings.seed = 77 + seed;
            const FilmImage film = renderFilm(device_, scene, settings);
            samples += meanSamples(film) / kSeeds;
            for (size_t i = 0; i < film.mean.pixels.size(); ++i)
                errors[adaptive] += std::pow(film.mean.pixels[i] - reference.mean.pixels[i], 2.0f) /
                                    static_cast<double>(film.mean.pixels.size() * kSeeds);
        }
        std::printf("%s: mean squared error %.4g, %.2f samples a pixel in the film\n", adaptive ? "adaptive" : "even",
                    errors[adaptive], samples);
        EXPECT_LE(samples, 64.0 + 1e-3);
    }
    EXPECT_LT(errors[1], 0.75 * errors[0]);
}

/// Rates by the formula: deviations 0, 1 and 3 beside each other, apart by more than the smoothing reaches.
TEST(SampleRates, GoByTheDeviation) {
    FilmImage pilot{Bitmap(96, 8, 3), Bitmap(96, 8, 3), Bitmap(96, 8, 1)};
    std::fill(pilot.mean.pixels.begin(), pilot.mean.pixels.end(), 1.0f);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 96; ++x)
            for (int c = 0; c < 3; ++c) pilot.variance.at(x, y)[c] = x < 32 ? 0.0f : x < 64 ? 1.0f : 9.0f;
    AdaptiveConfig config;
    const std::vector<float> rates = sampleRates(pilot, config);
    ASSERT_EQ(rates.size(), 96u);
    EXPECT_NEAR(std::accumulate(rates.begin(), rates.end(), 0.0) / 96.0, 1.0, 1e-5);
    EXPECT_FLOAT_EQ(rates[0], 0.25f);
    EXPECT_NEAR(rates[8 * 10] / rates[8 * 6], 3.0, 1e-3);
    // For an error of 1/4: variance over that of 64 samples, where fewer than all samples do.
    config.targetError = 0.25;
    const std::vector<float> few = sampleRates(pilot, config);
    EXPECT_NEAR(few[8 * 10], 9.0 / 1.01 / (0.25 * 0.25 * 64.0), 1e-4);
    EXPECT_LT(std::accumulate(few.begin(), few.end(), 0.0) / 96.0, 1.0);
}

TEST_F(Adaptive, RefusesWhatCannotBe) {
    RenderSettings settings = smallImage(8, 64, 1);
    settings.adaptive = true;
    settings.sampler = "stratified";
    EXPECT_THROW(renderFilm(device_, unlikeLamps(), settings), Error);
    settings.sampler = "sobol";
    settings.spp = 4;
    EXPECT_THROW(renderFilm(device_, unlikeLamps(), settings), Error);
}

}  // namespace
}  // namespace raylab::support
