#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "engine/core/error.h"
#include "engine/measure/image_error.h"
#include "engine/render/denoise.h"
#include "engine/scene/import.h"
#include "tests/support/gpu_test.h"
#include "tests/support/paths.h"

namespace raylab::support {
namespace {

constexpr int kWidth = 61, kHeight = 47;

bool never() { return false; }

/// A film whose light is known, with noise of a known variance, before surfaces that face +Z, 5 away.
struct Noisy {
    FilmImage film{.mean = Bitmap(kWidth, kHeight, 3),
                   .variance = Bitmap(kWidth, kHeight, 3),
                   .samples = Bitmap(kWidth, kHeight, 1)};
    DenoiseGuides guides{Bitmap(kWidth, kHeight, 3), Bitmap(kWidth, kHeight, 3), Bitmap(kWidth, kHeight, 3)};
    Bitmap truth{kWidth, kHeight, 3};

    /// `light` and `albedo`: of x, y. `deviation`: of a pixel's mean over `samples`, over its truth.
    template <class Light, class Albedo>
    Noisy(Light light, Albedo albedo, float deviation, float samples) {
        std::mt19937 random(7);
        std::normal_distribution<float> normal;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                *film.samples.at(x, y) = samples;
                const float noise = deviation * normal(random);  // the same in all channels, as a firefly is
                for (int c = 0; c < 3; ++c) {
                    const float value = light(x, y) * albedo(x, y);
                    truth.at(x, y)[c] = value;
                    film.mean.at(x, y)[c] = value * (1.0f + noise);
                    film.variance.at(x, y)[c] = value * value * deviation * deviation * samples;
                    guides.albedo.at(x, y)[c] = albedo(x, y);
                    guides.normal.at(x, y)[c] = c == 2 ? 1.0f : 0.5f;
                    guides.depth.at(x, y)[c] = 5.0f;
                }
            }
    }
};

float flat(int, int) { return 1.0f; }
float checkered(int x, int y) { return (x / 3 + y / 3) % 2 == 0 ? 0.8f : 0.2f; }

/// Root of the mean squared error over the truth, of pixels that `isMeant` accepts.
template <class Accept>
double relativeError(const Bitmap& picture, const Bitmap& truth, Accept isMeant) {
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            if (!isMeant(x, y)) continue;
            const double error = static_cast<double>(picture.at(x, y)[1] / truth.at(x, y)[1]) - 1.0;
            sum += error * error;
            ++count;
        }
    return std::sqrt(sum / count);
}

bool everywhere(int, int) { return true; }

class Denoise : public GpuTest {
protected:
    Bitmap denoised(const Noisy& noisy, size_t mostPixels = 1u << 20) {
        return Denoiser(device_, mostPixels).filter(noisy.film, noisy.guides, never).value();
    }
};

/// Of an even wall under a pattern of colours nearly all noise goes, and none of the pattern.
TEST_F(Denoise, KeepsThePatternAndTakesTheNoise) {
    const Noisy noisy(flat, checkered, 0.3f, 16.0f);
    const double before = relativeError(noisy.film.mean, noisy.truth, everywhere);
    EXPECT_NEAR(before, 0.3, 0.02);
    EXPECT_LT(relativeError(denoised(noisy), noisy.truth, everywhere), before / 6.0);
}

/// A sample a pixel has no variance of its own: that of the pixels around is taken.
TEST_F(Denoise, TakesTheNoiseOfSingleSamples) {
    Noisy noisy(flat, checkered, 0.3f, 1.0f);
    std::ranges::fill(noisy.film.variance.pixels, 0.0f);
    EXPECT_LT(relativeError(denoised(noisy), noisy.truth, everywhere), 0.3 / 6.0);
}

/// A pixel with few samples among others does not make these any smoother than their own variance says.
TEST_F(Denoise, EstimatesOnlyWhatHasFewSamples) {
    const auto slope = [](int x, int y) { return 0.1f + 0.01f * static_cast<float>(x * y % 17); };
    Noisy noisy(slope, flat, 0.0f, 64.0f);
    const int x0 = kWidth / 2, y0 = kHeight / 2;
    *noisy.film.samples.at(x0, y0) = 2.0f;
    const auto isFar = [&](int x, int y) { return std::max(std::abs(x - x0), std::abs(y - y0)) > 5; };  // a pixel a level
    EXPECT_LT(relativeError(denoised(noisy), noisy.truth, isFar), 1e-6);
}

/// Pixels without samples get what their surface has around them, and give nothing.
TEST_F(Denoise, FillsWhatHasNoSamples) {
    Noisy noisy(flat, checkered, 0.0f, 64.0f);
    const auto isHole = [](int x, int y) { return x > 20 && x < 24 && y > 20 && y < 24; };
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            if (isHole(x, y)) {
                *noisy.film.samples.at(x, y) = 0.0f;
                std::fill_n(noisy.film.mean.at(x, y), 3, 0.0f);
            }
    EXPECT_LT(relativeError(denoised(noisy), noisy.truth, everywhere), 1e-5);
}

/// Nothing runs over an edge between surfaces: neither where normals differ nor where depths do, however noisy.
TEST_F(Denoise, StopsAtEdgesOfTheFirstHits) {
    const auto isLeft = [](int x) { return x < kWidth / 2; };
    for (const bool byDepth : {false, true}) {
        SCOPED_TRACE(byDepth ? "depth" : "normals");
        Noisy noisy([&](int x, int) { return isLeft(x) ? 1.0f : 1.3f; }, flat, 0.5f, 16.0f);
        for (int y = 0; y < kHeight; ++y)
            for (int x = kWidth / 2; x < kWidth; ++x)
                if (byDepth)
                    *noisy.guides.depth.at(x, y) = 6.0f;
                else
                    std::ranges::copy(std::array{1.0f, 0.5f, 0.5f}, noisy.guides.normal.at(x, y));
        const Bitmap picture = denoised(noisy);
        for (const int column : {kWidth / 2 - 1, kWidth / 2})
            EXPECT_LT(relativeError(picture, noisy.truth, [&](int x, int) { return x == column; }), 0.15) << column;
        EXPECT_LT(relativeError(picture, noisy.truth, everywhere), 0.5 / 4.0);
    }
}

/// Shadows are in no guide: light that differs by more than its noise stays as it is.
TEST_F(Denoise, KeepsWhatIsNoNoise) {
    const auto shadow = [](int x, int y) { return x + y < 50 ? 1.0f : 0.2f; };
    const Noisy noisy(shadow, flat, 0.02f, 64.0f);
    const Bitmap picture = denoised(noisy);
    EXPECT_LT(relativeError(picture, noisy.truth, everywhere), 0.012);
    const auto isAtTheEdge = [](int x, int y) { return std::abs(x + y - 50) < 2; };
    EXPECT_LT(relativeError(picture, noisy.truth, isAtTheEdge), 0.03);
}

TEST_F(Denoise, LeavesAPictureWithoutNoiseAsItIs) {
    const auto slope = [](int x, int y) { return 0.1f + 0.01f * static_cast<float>(x * y % 17); };
    const Noisy noisy(slope, checkered, 0.0f, 64.0f);
    EXPECT_LT(relativeError(denoised(noisy), noisy.truth, everywhere), 1e-6);
}

/// A picture that is filtered strip by strip is that of one piece, to the bit.
TEST_F(Denoise, StripsShowNoSeams) {
    constexpr int kRows = 200;
    FilmImage film{.mean = Bitmap(8, kRows, 3), .variance = Bitmap(8, kRows, 3), .samples = Bitmap(8, kRows, 1)};
    DenoiseGuides guides{Bitmap(8, kRows, 3), Bitmap(8, kRows, 3), Bitmap(8, kRows, 3)};
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(0.1f, 1.0f);
    for (Bitmap* bitmap : {&film.mean, &film.variance, &guides.albedo, &guides.normal, &guides.depth})
        std::ranges::generate(bitmap->pixels, [&] { return uniform(random); });
    std::ranges::fill(film.samples.pixels, 2.0f);
    const Bitmap whole = Denoiser(device_).filter(film, guides, never).value();
    EXPECT_EQ(Denoiser(device_, 8 * 150).filter(film, guides, never).value().pixels, whole.pixels);
    EXPECT_THROW(Denoiser(device_, 8 * 100).filter(film, guides, never), Error);
}

TEST_F(Denoise, EndsWhereItIsTold) {
    const Noisy noisy(flat, flat, 0.1f, 4.0f);
    EXPECT_FALSE(Denoiser(device_).filter(noisy.film, noisy.guides, [] { return true; }));
}

/// Of a rendering: less than half of the error against many more samples of other random numbers, and the film's own
/// figures stay.
TEST_F(Denoise, HalvesTheErrorOfARendering) {
    const Scene scene = importScene(binaryFolder() / "assets/cornell.glb");
    RenderSettings settings = smallImage(96, 2048, 6);
    settings.seed = 99;
    const Bitmap reference = renderFilm(device_, scene, settings).mean;
    settings.spp = 8;
    settings.seed = 1;
    settings.denoise = "atrous";
    Renderer renderer(device_, scene, settings);
    while (renderer.step()) continue;
    const FilmImage raw = renderer.snapshot(), image = renderer.develop();
    EXPECT_TRUE(raw.denoised.pixels.empty());
    EXPECT_EQ(image.mean.pixels, raw.mean.pixels);
    const double before = std::sqrt(compareImages(image.mean, reference).relMse);
    const double after = std::sqrt(compareImages(image.picture(), reference).relMse);
    EXPECT_LT(after, 0.5 * before) << before;
    EXPECT_GT(renderer.times().denoiseDevice, 0.0);
}

/// The guides are those of the camera and the scene that are rendered now.
TEST_F(Denoise, FollowsTheCamera) {
    const Scene scene = importScene(binaryFolder() / "assets/cornell.glb");
    RenderSettings settings = smallImage(32, 4, 3);
    settings.denoise = "atrous";
    Renderer renderer(device_, scene, settings);
    const auto finish = [](Renderer& r) {
        while (r.step()) continue;
        return r.develop().denoised.pixels;
    };
    finish(renderer);
    Camera other = renderer.prepared().camera;
    other.position.x += 100.0f;
    renderer.restart(settings, other);
    Scene moved = scene;
    moved.cameras.insert(moved.cameras.begin(), other);
    Renderer fresh(device_, moved, settings);
    EXPECT_EQ(finish(renderer), finish(fresh));
}

TEST_F(Denoise, LeavesViewsAlone) {
    RenderSettings settings = smallImage(16, 2, 3);
    settings.denoise = "atrous";
    settings.integrator = "normal";
    Renderer renderer(device_, importScene(binaryFolder() / "assets/cornell.glb"), settings);
    while (renderer.step()) continue;
    EXPECT_TRUE(renderer.develop().denoised.pixels.empty());
}

}  // namespace
}  // namespace raylab::support
