#include <algorithm>
#include <array>
#include <cmath>

#include "engine/measure/stability/cases.h"
#include "engine/measure/stability/render_case.h"
#include "engine/measure/stability/scene_parts.h"

/// S33, S34: sums of many samples, and numbers that ought to know nothing of each other.
namespace raylab::stability {
namespace {

constexpr float kDim = 0.1f;
constexpr int kFilmSize = 8;
constexpr int kSplitColumn = kFilmSize / 2;

/// Radiance kDim to the left of the middle of the pixels of kSplitColumn, none to the right.
Scene splitScene() {
    Scene scene;
    const float edge = 0.5f / static_cast<float>(kFilmSize);
    addMesh(scene, quad(addMaterial(scene, lamp(kDim)), {-2, 0, 2}, {edge, 0, 2}, {edge, 0, -2}, {-2, 0, -2}));
    lookDown(scene, 4.0f);
    return scene;
}

/// The largest relative error of pixels to the left of the edge and on it. A (0,2)-sequence has exactly half of 2^k
/// samples on each side, so that their mean is known.
double splitError(const Context& context, int64_t samples) {
    RenderSettings settings = smallImage(context.settings, kFilmSize, samples, 0);
    settings.sampler = "sobol";
    settings.environment = "none";
    const FilmImage film = renderFilm(context, splitScene(), settings);
    double largest = 0.0;
    for (int y = 0; y < kFilmSize; ++y)
        for (int x = 0; x <= kSplitColumn; ++x) {
            const double exact = (x == kSplitColumn ? 0.5 : 1.0) * static_cast<double>(kDim);
            largest = std::max(largest, std::abs(static_cast<double>(*film.mean.at(x, y)) / exact - 1.0));
        }
    return largest;
}

/// Of the mean by a sum in float, of as many samples that are kDim and 0 in turn.
double floatSumError(int64_t samples) {
    float sum = 0.0f;
    for (int64_t i = 0; i < samples; i += 2) sum += kDim;
    return std::abs(static_cast<double>(sum) / (0.5 * static_cast<double>(samples) * static_cast<double>(kDim)) - 1.0);
}

constexpr int kNoiseSize = 64;
constexpr int kMostLag = 8;
constexpr int kLags = 2 * kMostLag + 1;
/// Standard errors. Of the 144 lags of one image and the 289 between two, one is beyond by chance once in 4000 runs.
constexpr double kMostScore = 5.0;

/// A floor below a sky with a white half: all pixels estimate the same, and differ by their random numbers alone.
Bitmap noiseImage(const Context& context, const std::string& sampler, int64_t seed) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.8f)), 2.0f));
    scene.environment = environmentOf(32, 16, [](const glm::dvec3& d) { return d.x > 0.0 ? 1.0 : 0.1; });
    lookDown(scene, 2.0f);
    RenderSettings settings = smallImage(context.settings, kNoiseSize, 1, 1);
    settings.sampler = sampler;
    settings.seed = seed;
    return renderFilm(context, scene, settings).mean;
}

/// Without mean, of variance 1.
std::vector<double> standardised(const Bitmap& image) {
    std::vector<double> values;
    double mean = 0.0, square = 0.0;
    for (size_t i = 0; i < image.pixels.size(); i += 3) values.push_back(static_cast<double>(image.pixels[i]));
    for (const double value : values) mean += value / static_cast<double>(values.size());
    for (const double value : values) square += (value - mean) * (value - mean) / static_cast<double>(values.size());
    for (double& value : values) value = (value - mean) / std::sqrt(square);
    return values;
}

/// Correlation of the pixels of `a` with those of `b` that are (dx, dy) further, in standard errors of it.
double scoreAt(const std::vector<double>& a, const std::vector<double>& b, int dx, int dy) {
    double sum = 0.0, count = 0.0;
    for (int y = std::max(0, -dy); y < std::min(kNoiseSize, kNoiseSize - dy); ++y)
        for (int x = std::max(0, -dx); x < std::min(kNoiseSize, kNoiseSize - dx); ++x) {
            sum += a[static_cast<size_t>(y * kNoiseSize + x)] * b[static_cast<size_t>((y + dy) * kNoiseSize + x + dx)];
            count += 1.0;
        }
    return sum / std::sqrt(count);
}

/// Scores of all lags; the middle of an image with itself left out.
Number correlationNumber(const std::string& what, const Bitmap& first, const Bitmap& second, double limit) {
    constexpr int kCell = 8;
    const std::vector<double> a = standardised(first), b = standardised(second);
    Number number{what,        0.0, limit, "standard errors", "correlation of noise at distances of 8 pixels at most",
                  std::nullopt};
    Bitmap map(kLags * kCell, kLags * kCell, 3);
    for (int dy = -kMostLag; dy <= kMostLag; ++dy)
        for (int dx = -kMostLag; dx <= kMostLag; ++dx) {
            const bool isItself = &first == &second && dx == 0 && dy == 0;
            const double score = isItself ? 0.0 : scoreAt(a, b, dx, dy);
            number.value = std::max(number.value, std::abs(score));
            const auto grey = static_cast<float>(std::clamp(0.5 + 0.1 * score, 0.0, 1.0));
            for (int y = 0; y < kCell; ++y)
                for (int x = 0; x < kCell; ++x)
                    std::fill_n(map.at((dx + kMostLag) * kCell + x, (dy + kMostLag) * kCell + y), 3, grey);
        }
    number.picture = std::move(map);
    return number;
}

}  // namespace

std::vector<Number> measureManySamples(const Context& context) {
    const int64_t most = context.quick ? 1 << 14 : 1 << 16;
    Plot plot{"samples", "relative error of the mean", true, true, {{"the film", {}}, {"a sum in float", {}}}};
    double error = 0.0;
    for (int64_t samples = 64; samples <= most; samples *= 4) {
        error = splitError(context, samples);
        plot.series[0].points.emplace_back(samples, error);
        plot.series[1].points.emplace_back(samples, floatSumError(samples));
    }
    Number number{"error of the mean of " + std::to_string(most) + " samples",
                  error,
                  1e-4,
                  "of exact",
                  "a sum in float is off by " + shortText(floatSumError(1 << 20)) + " after 1048576",
                  std::nullopt};
    number.plot = std::move(plot);
    return {std::move(number)};
}

std::vector<Number> measureCorrelation(const Context& context) {
    std::vector<Number> numbers;
    for (const std::string sampler : {"sobol", "independent", "blue-noise"}) {
        const double limit = sampler == "blue-noise" ? kNoLimit : kMostScore;
        const Bitmap image = noiseImage(context, sampler, 1), other = noiseImage(context, sampler, 2);
        numbers.push_back(correlationNumber("pixels of one image, " + sampler, image, image, limit));
        numbers.push_back(correlationNumber("pixels of seeds 1 and 2, " + sampler, image, other, limit));
    }
    return numbers;
}

}  // namespace raylab::stability
