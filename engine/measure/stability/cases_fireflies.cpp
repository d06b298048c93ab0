#include <algorithm>
#include <cmath>

#include "engine/measure/image_error.h"
#include "engine/measure/stability/cases.h"
#include "engine/measure/stability/render_case.h"
#include "engine/measure/stability/scene_parts.h"
#include "engine/scene/import.h"

namespace raylab::stability {
namespace {

/// A small lamp above a glass ball on a floor: light that paths find seldom.
Scene fireflyScene() {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.7f)), 3.0f));
    addMesh(scene, smoothBall(addMaterial(scene, glass()), 0.6f, {0.0f, 0.7f, 0.0f}));
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(60.0f)), 0.4f, 3.0f));
    lookAt(scene, {0.0f, 2.5f, 4.0f}, {0.0f, 0.3f, 0.0f}, 0.7f);
    return scene;
}

double percentileOverMean(const FilmImage& film, double percentile) {
    std::vector<double> values;
    double sum = 0.0;
    for (size_t i = 0; i < film.mean.pixels.size(); i += 3) {
        values.push_back(static_cast<double>(film.mean.pixels[i + 1]));
        sum += values.back();
    }
    std::ranges::sort(values);
    const auto at = static_cast<size_t>(percentile * static_cast<double>(values.size() - 1));
    return sum > 0.0 ? values[at] * static_cast<double>(values.size()) / sum : 0.0;
}

/// Error by samples: pairs of images of other seeds differ by sqrt(2) of it.
std::vector<glm::dvec2> errorsBySamples(const Context& context, const Scene& scene, FilmImage& last) {
    std::vector<glm::dvec2> points;
    for (const int spp : {8, 32, 128, 512}) {
        if (context.quick && spp > 128) break;
        double square = 0.0;
        const int pairs = context.quick ? 1 : 4;
        for (int pair = 0; pair < pairs; ++pair) {
            RenderSettings settings = smallImage(context.settings, 48, spp, 8);
            settings.sampler = "independent";
            settings.clamp = 4.0;
            settings.seed = 1000 + 2 * pair;
            const FilmImage a = renderFilm(context, scene, settings);
            ++settings.seed;
            last = renderFilm(context, scene, settings);
            square += compareImages(a.mean, last.mean).mse / pairs;
        }
        points.emplace_back(spp, std::sqrt(0.5 * square));
    }
    return points;
}

std::vector<Number> fireflyNumbers(const Context& context, const Scene& scene, const std::string& what) {
    FilmImage clamped;
    std::vector<glm::dvec2> errors = errorsBySamples(context, scene, clamped);
    const double slope = logSlope(errors);
    std::vector<Number> numbers = {
        {"slope of the error over samples is off -.5 by: " + what, std::abs(slope + 0.5), 0.05, "",
         "slope " + shortText(slope) + ", independent samples, clamped at 4", std::nullopt},
        {"light that the clamp takes: " + what, clamped.clampedEnergy, kNoLimit, "of all", "", std::nullopt}};
    const glm::dvec2 first = errors.front(), end = errors.back();
    numbers.front().plot =
        Plot{"samples",
             "RMSE",
             true,
             true,
             {{"measured", std::move(errors)}, {"slope -.5", {first, {end.x, first.y * std::sqrt(first.x / end.x)}}}}};
    for (const int spp : {16, 64}) {
        const RenderSettings settings = smallImage(context.settings, 48, spp, 8);
        const FilmImage film = renderFilm(context, scene, settings);
        numbers.push_back({"brightest of 10,000 pixels at " + std::to_string(spp) + " samples: " + what,
                           percentileOverMean(film, 0.9999), kNoLimit, "of the mean", "without a clamp", std::nullopt});
        showImage(numbers.back(), scene, settings, film);
    }
    return numbers;
}

/// A point light above a plate of glass above a floor. Exactly, the plate passes T of it.
Scene plateScene() {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(1.0f)), 2.0f));
    addMesh(scene, box(addMaterial(scene, glass()), {-0.4f, 0.5f, -0.4f}, {0.4f, 0.6f, 0.4f}));
    Light light;
    light.position = {0.0f, 1.0f, 0.0f};
    light.intensity = glm::vec3(1.0f);
    scene.lights = {light};
    lookAtPoint(scene, {0.0f, 0.3f, 0.01f}, glm::vec3(0.0f));
    return scene;
}

}  // namespace

std::vector<Number> measureFireflies(const Context& context) {
    return fireflyNumbers(context, fireflyScene(), "glass ball below a lamp");
}

std::vector<Number> measureWaterCaustic(const Context& context) {
    Context here = context;
    here.quick = true;
    return fireflyNumbers(here, importScene(context.sceneFile("water-caustic/water-caustic.glb")), "water caustic");
}

std::vector<Number> measureMissedCaustic(const Context& context) {
    Scene scene = plateScene();
    const double mean = estimateOf(renderFilm(context, scene, smallImage(context.settings, 8, 64, 8))).mean;
    const double thickness = 0.1, ior = 1.5;
    // Straight down, the plate shortens the way as glass does: (d - t + t/n), and passes 2n/(n^2 + 1).
    const double distance = 1.0 - thickness + thickness / ior;
    const double exact = 2.0 * ior / (ior * ior + 1.0) / (kPi * distance * distance);
    Number number{
        "light of a point light behind glass that is missing",
        1.0 - mean / exact,
        kNoLimit,
        "of direct light",
        "by design: no path from the eye meets a point through glass; " + shortText(mean) + " of " + shortText(exact),
        std::nullopt};
    lookAt(scene, {1.5f, 1.8f, 2.5f}, {0.0f, 0.3f, 0.0f}, 0.8f);
    const RenderSettings settings = smallImage(context.settings, 64, 16, 8);
    showImage(number, scene, settings, renderFilm(context, scene, settings));
    return {std::move(number)};
}

}  // namespace raylab::stability
