#include "engine/measure/stability/render_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "engine/measure/statistics.h"
#include "engine/render/lighting.h"
#include "engine/render/renderer.h"
#include "engine/render/tonemap.h"

namespace raylab::stability {

RenderSettings smallImage(RenderSettings settings, int64_t size, int64_t spp, int64_t depth) {
    settings.width = size;
    settings.height = size;
    settings.spp = spp;
    settings.depth = depth;
    settings.seed = 20240607;
    return settings;
}

FilmImage renderFilm(Device& device, Scene scene, const RenderSettings& settings,
                     const std::function<void()>& betweenSteps) {
    settleEnvironment(scene, settings);
    Renderer renderer(device, scene, settings);
    while (renderer.step())
        if (betweenSteps) betweenSteps();
    return renderer.snapshot();
}

FilmImage renderFilm(const Context& context, const Scene& scene, const RenderSettings& settings) {
    return renderFilm(context.device, scene, settings, [&context] { context.check(); });
}

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

namespace {

bool isWrongPixel(const FilmImage& film, size_t pixel, double exact, double relativeTolerance) {
    for (size_t c = 0; c < 3; ++c) {
        const double error = std::abs(static_cast<double>(film.mean.pixels[3 * pixel + c]) - exact);
        if (!(error <= relativeTolerance * std::abs(exact))) return true;
    }
    return false;
}

}  // namespace

size_t countWrongPixels(const FilmImage& film, double exact, double relativeTolerance, std::optional<Bitmap>& picture) {
    Bitmap marked = displayed(film.mean);
    size_t wrong = 0;
    for (size_t i = 0; i < film.mean.pixelCount(); ++i) {
        const bool isWrong = isWrongPixel(film, i, exact, relativeTolerance);
        wrong += isWrong ? 1u : 0u;
        for (size_t c = 0; c < 3; ++c)
            marked.pixels[3 * i + c] = isWrong ? (c == 0 ? 1.0f : 0.0f) : 0.3f * marked.pixels[3 * i + c];
    }
    if (wrong > 0) picture = std::move(marked);
    return wrong;
}

void judgePixels(Number& number, const Scene& scene, const RenderSettings& settings, const FilmImage& film,
                 double exact, double relativeTolerance) {
    std::optional<Bitmap> picture;
    number.value += static_cast<double>(countWrongPixels(film, exact, relativeTolerance, picture));
    if (!picture || number.picture) return;
    number.picture = std::move(picture);
    number.evidence = imageEvidence(scene, settings);
    const auto width = static_cast<size_t>(film.mean.width), height = static_cast<size_t>(film.mean.height);
    for (size_t i = 0; i < width * height && number.evidence->pixels.size() < kMostEvidence; ++i)
        if (isWrongPixel(film, i, exact, relativeTolerance))
            number.evidence->pixels.emplace_back((static_cast<double>(i % width) + 0.5) / static_cast<double>(width),
                                                 (static_cast<double>(i / width) + 0.5) / static_cast<double>(height));
}

Bitmap scatterPicture(std::span<const glm::dvec2> points, int size) {
    Bitmap picture(size, size, 3);
    std::ranges::fill(picture.pixels, 0.03f);
    for (const glm::dvec2& point : points) {
        const glm::ivec2 centre(point * static_cast<double>(size));
        for (int y = centre.y - 1; y <= centre.y + 1; ++y)
            for (int x = centre.x - 1; x <= centre.x + 1; ++x) {
                float* const rgb = picture.at(std::clamp(x, 0, size - 1), std::clamp(y, 0, size - 1));
                rgb[0] = 1.0f;
                rgb[1] = std::min(rgb[1] + 0.05f, 1.0f);
            }
    }
    return picture;
}

glm::dvec2 onMap(const glm::dvec3& direction) {
    const glm::dvec3 d = glm::normalize(direction);
    return {0.5 + std::atan2(d.x, -d.z) / (2.0 * std::numbers::pi),
            std::acos(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi};
}

void showWrongRays(Number& number, const Scene& scene, const RenderSettings& settings,
                   std::span<const shared::RayData> rays, std::span<const size_t> wrong) {
    if (number.passes()) return;
    std::vector<glm::dvec2> where;
    for (const size_t i : wrong) where.push_back(onMap(glm::dvec3(rays[i].direction)));
    number.picture = scatterPicture(where);
    number.evidence = rayEvidence(scene, settings, rays, wrong);
}

Number rayNumber(std::string what, const Scene& scene, const RenderSettings& settings,
                 std::span<const shared::RayData> rays, std::span<const size_t> wrong, size_t of) {
    Number number = countOf(std::move(what), wrong.size(), "rays", "of " + std::to_string(of));
    showWrongRays(number, scene, settings, rays, wrong);
    return number;
}

double logSlope(std::span<const glm::dvec2> points) {
    std::vector<double> x, y;
    for (const glm::dvec2& point : points) {
        x.push_back(std::log(point.x));
        y.push_back(std::log(point.y));
    }
    return fitLine(x, y).slope;
}

void showImage(Number& number, const Scene& scene, const RenderSettings& settings, const FilmImage& film) {
    if (number.passes() && std::isfinite(number.limit)) return;
    number.picture = displayed(film.mean);
    number.evidence = imageEvidence(scene, settings);
}

std::string shortText(double number) {
    std::array<char, 32> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.4g", number);
    return buffer.data();
}

Bitmap displayed(const Bitmap& radiance) { return tonemapImage(radiance, 0.0, "filmic"); }

}  // namespace raylab::stability
