#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "engine/core/stopwatch.h"
#include "engine/measure/stability/cases.h"
#include "engine/measure/stability/render_case.h"
#include "engine/measure/stability/scene_parts.h"
#include "engine/render/renderer.h"
#include "engine/scene/import.h"

namespace raylab::stability {
namespace {

std::string text(double number) {
    std::array<char, 32> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.4g", number);
    return buffer.data();
}

Number nonFiniteNumber(const std::string& what, const FilmImage& film) {
    return {"pixels with a sample that is not finite: " + what,
            static_cast<double>(film.nonFinitePixels),
            0.0,
            "pixels",
            "of " + std::to_string(film.mean.pixelCount()),
            std::nullopt};
}

/// Pixels whose luminance is not above zero.
Number blackNumber(const std::string& what, const FilmImage& film) {
    Number number{
        "black pixels: " + what, 0.0, 0.0, "pixels", "of " + std::to_string(film.mean.pixelCount()), std::nullopt};
    for (size_t i = 0; i < film.mean.pixels.size(); i += 3)
        number.value += film.mean.pixels[i] + film.mean.pixels[i + 1] + film.mean.pixels[i + 2] > 0.0f ? 0.0 : 1.0;
    if (!number.passes()) number.picture = displayed(film.mean);
    return number;
}

Material metal(float reflectance, float roughness) {
    Material material;
    material.baseColor = glm::vec3(reflectance);
    material.metallic = 1.0f;
    material.roughness = roughness;
    return material;
}

Mesh smoothBall(uint32_t material, float radius, const glm::vec3& centre, uint32_t rings = 24) {
    Mesh mesh = meshOf(sphere(radius, rings, 2 * rings, centre), material);
    for (const glm::vec3& p : mesh.positions) mesh.normals.push_back(glm::normalize(p - centre));
    return mesh;
}

constexpr float kMirror = 0.9f;

/// Two mirrors that glow with radiance 1 and face each other, seen at right angles: the sum of .9^k.
Scene corridor() {
    Scene scene;
    Material mirror = metal(kMirror, 0.0f);
    mirror.emission = glm::vec3(1.0f);
    const uint32_t material = addMaterial(scene, mirror);
    addMesh(scene, floorQuad(material, 1.0f, 0.0f));
    addMesh(scene, ceilingQuad(material, 1.0f, 1.0f));
    lookAtPoint(scene, {0.1f, 0.5f, 0.2f}, {0.1f, 0.0f, 0.2f});
    scene.cameras[0].up = {0, 0, 1};
    return scene;
}

double corridorRadiance(int depth) { return (1.0 - std::pow(double{kMirror}, depth + 1)) / (1.0 - double{kMirror}); }

/// Slope of a line through points by least squares.
double slopeOf(std::span<const glm::dvec2> points) {
    glm::dvec2 mean(0.0);
    for (const glm::dvec2& p : points) mean += p / static_cast<double>(points.size());
    double xy = 0.0, xx = 0.0;
    for (const glm::dvec2& p : points) {
        xy += (p.x - mean.x) * (p.y - mean.y);
        xx += (p.x - mean.x) * (p.x - mean.x);
    }
    return xy / xx;
}

double deviceSeconds(const Context& context, const Scene& scene, const RenderSettings& settings) {
    Renderer renderer(context.device, scene, settings);
    while (renderer.step()) context.check();
    return renderer.times().device;
}

/// Of the cost of a path by its depth on log-log axes, without what a path of one event costs.
double timeExponent(const Context& context) {
    const Scene scene = corridor();
    std::vector<glm::dvec2> points;
    for (const int depth : {25, 50, 100, 200}) {
        RenderSettings settings = smallImage(context.settings, 32, context.quick ? 16 : 64, depth);
        settings.rouletteDepth = depth;
        points.emplace_back(std::log(depth), std::log(deviceSeconds(context, scene, settings)));
    }
    return slopeOf(points);
}

struct GlassScene {
    std::string what;
    Scene scene;
    double exact = 1.0;  ///< radiance; n^2 within glass
};

std::vector<GlassScene> glassScenes() {
    std::vector<GlassScene> scenes;
    const auto add = [&](const std::string& what) -> Scene& {
        scenes.push_back({what, {}, 1.0});
        Scene& scene = scenes.back().scene;
        addMaterial(scene, glass());
        scene.environment = constantEnvironment(1.0f);
        lookAt(scene, {0.0f, 0.5f, 3.0f}, glm::vec3(0.0f), 0.8f);
        return scene;
    };
    addMesh(add("a ball"), smoothBall(0, 1.0f, glm::vec3(0.0f)));
    Scene& nested = add("a ball within a ball");
    addMesh(nested, smoothBall(0, 1.0f, glm::vec3(0.0f)));
    addMesh(nested, smoothBall(0, 0.6f, glm::vec3(0.0f)));
    Scene& overlapping = add("overlapping balls");
    addMesh(overlapping, smoothBall(0, 0.8f, {-0.4f, 0.0f, 0.0f}));
    addMesh(overlapping, smoothBall(0, 0.8f, {0.4f, 0.0f, 0.0f}));
    Scene& open = add("an open shell");
    Mesh shell = smoothBall(0, 1.0f, glm::vec3(0.0f));
    shell.triangles.resize(shell.triangles.size() / 2);
    addMesh(open, std::move(shell));
    Scene& inside = add("a camera within a ball");
    addMesh(inside, smoothBall(0, 5.0f, glm::vec3(0.0f)));
    scenes.back().exact = 1.5 * 1.5;
    return scenes;
}

/// A white sky of radiance 1 looks 1 through clear glass: more is made of nothing.
void measureGlassScene(const Context& context, const GlassScene& glassScene, std::vector<Number>& numbers) {
    RenderSettings settings = smallImage(context.settings, 32, 64, 256);
    settings.rouletteDepth = 256;
    const FilmImage film = renderFilm(context, glassScene.scene, settings);
    const float brightest = *std::ranges::max_element(film.mean.pixels);
    Number gain{"light gained in " + glassScene.what,
                static_cast<double>(brightest) / glassScene.exact - 1.0,
                1e-4,
                "of exact",
                "the darkest pixel has " + text(static_cast<double>(*std::ranges::min_element(film.mean.pixels))),
                std::nullopt};
    if (!gain.passes()) gain.picture = displayed(film.mean);
    numbers.push_back(std::move(gain));
    numbers.push_back(nonFiniteNumber(glassScene.what, film));
}

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

double rmseBetween(const Bitmap& a, const Bitmap& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const double difference = static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]);
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

/// Slope of the error over samples on log-log axes: pairs of images of other seeds differ by sqrt(2) of it.
double errorSlope(const Context& context, const Scene& scene, FilmImage& last) {
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
            square += std::pow(rmseBetween(a.mean, last.mean), 2.0) / pairs;
        }
        points.emplace_back(std::log(spp), 0.5 * std::log(square));
    }
    return slopeOf(points);
}

std::vector<Number> fireflyNumbers(const Context& context, const Scene& scene, const std::string& what) {
    FilmImage clamped;
    const double slope = errorSlope(context, scene, clamped);
    std::vector<Number> numbers = {
        {"slope of the error over samples is off -.5 by: " + what, std::abs(slope + 0.5), 0.05, "",
         "slope " + text(slope) + ", independent samples, clamped at 4", std::nullopt},
        {"light that the clamp takes: " + what, clamped.clampedEnergy, kNoLimit, "of all", "", std::nullopt}};
    for (const int spp : {16, 64}) {
        RenderSettings settings = smallImage(context.settings, 48, spp, 8);
        const FilmImage film = renderFilm(context, scene, settings);
        numbers.push_back({"brightest of 10,000 pixels at " + std::to_string(spp) + " samples: " + what,
                           percentileOverMean(film, 0.9999), kNoLimit, "of the mean", "without a clamp", std::nullopt});
    }
    return numbers;
}

/// Mean radiance of a metal floor of this alpha below a sky of a + b y.
Estimate metalFloor(const Context& context, double alpha) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, metal(0.8f, static_cast<float>(std::sqrt(alpha)))), 10.0f));
    scene.environment = environmentOf(64, 32, [](const glm::dvec3& d) { return 1.0 + 0.5 * d.y; });
    lookAt(scene, {0.0f, 2.0f, 3.0f}, glm::vec3(0.0f), 0.4f);
    return estimateOf(renderFilm(context, scene, smallImage(context.settings, 16, 256, 2)));
}

/// A floor below so many point lights of one power together, at one place.
Scene manyLights(uint32_t count) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.5f)), 2.0f));
    Light light;
    light.position = {0.3f, 1.0f, 0.2f};
    light.intensity = glm::vec3(10.0f / static_cast<float>(count));
    scene.lights.assign(count, light);
    lookDown(scene, 2.0f);
    return scene;
}

/// A point light above a plate of glass above a floor. Exactly, the plate passes T of it.
Scene plateScene() {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(1.0f)), 2.0f));
    addMesh(scene, box(addMaterial(scene, glass()), {-1.0f, 0.5f, -1.0f}, {1.0f, 0.6f, 1.0f}));
    Light light;
    light.position = {0.0f, 1.0f, 0.0f};
    light.intensity = glm::vec3(1.0f);
    scene.lights = {light};
    lookAtPoint(scene, {0.0f, 0.3f, 0.01f}, glm::vec3(0.0f));
    return scene;
}

}  // namespace

std::vector<Number> measureGrazing(const Context& context) {
    std::vector<Number> numbers;
    for (const float roughness : {0.0f, 0.2f}) {
        Scene scene;
        addMesh(scene, floorQuad(addMaterial(scene, metal(0.9f, roughness)), 100.0f));
        scene.environment = constantEnvironment(1.0f);
        const float angle = glm::radians(89.0f);
        lookAt(scene, {0.0f, std::cos(angle), std::sin(angle)}, glm::vec3(0.0f), 0.01f);
        const FilmImage film = renderFilm(context, scene, smallImage(context.settings, 32, 16, 4));
        const std::string what = "floor of roughness " + text(double{roughness}) + " at 89 degrees";
        numbers.push_back(blackNumber(what, film));
        numbers.push_back(nonFiniteNumber(what, film));
    }
    Scene scene;
    addMesh(scene, smoothBall(addMaterial(scene, metal(0.9f, 0.0f)), 1.0f, glm::vec3(0.0f), 4));
    scene.environment = constantEnvironment(1.0f);
    lookAt(scene, {0.0f, 0.0f, 4.0f}, glm::vec3(0.0f), 0.6f);
    numbers.push_back(blackNumber("mirror ball of 4 x 8 with smooth normals",
                                  renderFilm(context, scene, smallImage(context.settings, 64, 16, 8))));
    return numbers;
}

std::vector<Number> measureNormalTangentTest(const Context& context) {
    const Scene scene =
        importScene(context.sceneFile("gltf-features/NormalTangentTest/glTF-Binary/NormalTangentTest.glb"));
    RenderSettings settings = smallImage(context.settings, context.quick ? 64 : 128, 32, 8);
    settings.environment = "white";
    const FilmImage film = renderFilm(context, scene, settings);
    return {blackNumber("NormalTangentTest", film), nonFiniteNumber("NormalTangentTest", film)};
}

std::vector<Number> measureCorridor(const Context& context) {
    std::vector<Number> numbers;
    for (const int depth : {4, 10, 25}) {
        RenderSettings settings = smallImage(context.settings, 8, 4, depth);
        settings.rouletteDepth = depth;
        const double mean = estimateOf(renderFilm(context, corridor(), settings)).mean, exact = corridorRadiance(depth);
        numbers.push_back({"error of mirrors of .9 at depth " + std::to_string(depth), std::abs(mean / exact - 1.0),
                           1e-4, "of exact", text(mean) + ", exactly " + text(exact), std::nullopt});
    }
    numbers.push_back({"exponent of time over depth in a corridor of mirrors", timeExponent(context), kNoLimit, "",
                       "1: linear; shown, for other work on the machine moves it", std::nullopt});
    return numbers;
}

std::vector<Number> measureGlass(const Context& context) {
    std::vector<Number> numbers;
    for (const GlassScene& glassScene : glassScenes()) measureGlassScene(context, glassScene, numbers);
    return numbers;
}

std::vector<Number> measureFireflies(const Context& context) {
    return fireflyNumbers(context, fireflyScene(), "glass ball below a lamp");
}

std::vector<Number> measureWaterCaustic(const Context& context) {
    Context here = context;
    here.quick = true;
    return fireflyNumbers(here, importScene(context.sceneFile("water-caustic/water-caustic.glb")), "water caustic");
}

std::vector<Number> measureNearlySpecular(const Context& context) {
    std::vector<Number> numbers;
    const double mirror = metalFloor(context, 0.0).mean;
    for (const double alpha : {1e-3, 1e-4}) {
        const double rough = metalFloor(context, alpha).mean;
        numbers.push_back({"GGX of alpha " + text(alpha) + " against the mirror", std::abs(rough / mirror - 1.0), 0.01,
                           "of the mirror's", text(rough) + ", mirror " + text(mirror), std::nullopt});
    }
    return numbers;
}

std::vector<Number> measureManyLights(const Context& context) {
    std::vector<Number> numbers;
    Estimate one;
    for (const uint32_t count : {1u, 100u, 10'000u}) {
        const Stopwatch watch;
        const Estimate estimate =
            estimateOf(renderFilm(context, manyLights(count), smallImage(context.settings, 16, 16, 1)));
        if (count == 1) one = estimate;
        // Where nothing is random but the place within the pixel, rounding is left.
        const double sigma = std::hypot(estimate.standardError, one.standardError) + 1e-5 * one.mean;
        numbers.push_back({std::to_string(count) + " lights of one power", std::abs(estimate.mean - one.mean) / sigma,
                           4.0, "sigma", text(estimate.mean) + " in " + text(watch.seconds()) + " s", std::nullopt});
    }
    return numbers;
}

std::vector<Number> measureMissedCaustic(const Context& context) {
    const double mean = estimateOf(renderFilm(context, plateScene(), smallImage(context.settings, 8, 64, 8))).mean;
    const double thickness = 0.1, ior = 1.5;
    // Straight down, the plate shortens the way as glass does: (d - t + t/n), and passes 2n/(n^2 + 1).
    const double distance = 1.0 - thickness + thickness / ior;
    const double exact = 2.0 * ior / (ior * ior + 1.0) / (kPi * distance * distance);
    return {{"light of a point light behind glass that is missing", 1.0 - mean / exact, kNoLimit, "of direct light",
             "by design: no path from the eye meets a point through glass; " + text(mean) + " of " + text(exact),
             std::nullopt}};
}

}  // namespace raylab::stability
