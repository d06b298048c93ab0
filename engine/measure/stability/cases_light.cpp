#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/stopwatch.h"
#include "engine/measure/stability/cases.h"
#include "engine/measure/stability/render_case.h"
#include "engine/measure/stability/scene_parts.h"
#include "engine/render/renderer.h"
#include "engine/scene/import.h"

namespace raylab::stability {
namespace {

/// An image, and what it is of.
struct Seen {
    const Scene& scene;
    RenderSettings settings;
    FilmImage film;
};

Seen see(const Context& context, const Scene& scene, const RenderSettings& settings) {
    return {scene, settings, renderFilm(context, scene, settings)};
}

Number nonFiniteNumber(const std::string& what, const Seen& seen) {
    Number number = countOf("pixels with a sample that is not finite: " + what, seen.film.nonFinitePixels, "pixels",
                            "of " + std::to_string(seen.film.mean.pixelCount()));
    showImage(number, seen.scene, seen.settings, seen.film);
    return number;
}

/// Pixels whose luminance is not above zero.
Number blackNumber(const std::string& what, const Seen& seen) {
    const FilmImage& film = seen.film;
    Number number{
        "black pixels: " + what, 0.0, 0.0, "pixels", "of " + std::to_string(film.mean.pixelCount()), std::nullopt};
    for (size_t i = 0; i < film.mean.pixels.size(); i += 3)
        number.value += film.mean.pixels[i] + film.mean.pixels[i + 1] + film.mean.pixels[i + 2] > 0.0f ? 0.0 : 1.0;
    showImage(number, seen.scene, seen.settings, film);
    return number;
}

Material metal(float reflectance, float roughness) {
    Material material;
    material.baseColor = glm::vec3(reflectance);
    material.metallic = 1.0f;
    material.roughness = roughness;
    return material;
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

double deviceSeconds(const Context& context, const Scene& scene, const RenderSettings& settings) {
    Renderer renderer(context.device, scene, settings);
    while (renderer.step()) context.check();
    return renderer.times().device;
}

/// Seconds of paths by their depth.
std::vector<glm::dvec2> timesByDepth(const Context& context) {
    const Scene scene = corridor();
    std::vector<glm::dvec2> points;
    for (const int depth : {25, 50, 100, 200}) {
        RenderSettings settings = smallImage(context.settings, 32, context.quick ? 16 : 64, depth);
        settings.rouletteDepth = depth;
        points.emplace_back(depth, deviceSeconds(context, scene, settings));
    }
    return points;
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
    const Seen seen = see(context, glassScene.scene, settings);
    const FilmImage& film = seen.film;
    const float brightest = *std::ranges::max_element(film.mean.pixels);
    Number gain{"light gained in " + glassScene.what,
                static_cast<double>(brightest) / glassScene.exact - 1.0,
                1e-4,
                "of exact",
                "the darkest pixel has " + shortText(static_cast<double>(*std::ranges::min_element(film.mean.pixels))),
                std::nullopt};
    showImage(gain, glassScene.scene, settings, film);
    numbers.push_back(std::move(gain));
    numbers.push_back(nonFiniteNumber(glassScene.what, seen));
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

}  // namespace

std::vector<Number> measureGrazing(const Context& context) {
    std::vector<Number> numbers;
    for (const float roughness : {0.0f, 0.2f}) {
        Scene scene;
        addMesh(scene, floorQuad(addMaterial(scene, metal(0.9f, roughness)), 100.0f));
        scene.environment = constantEnvironment(1.0f);
        const float angle = glm::radians(89.0f);
        lookAt(scene, {0.0f, std::cos(angle), std::sin(angle)}, glm::vec3(0.0f), 0.01f);
        const Seen seen = see(context, scene, smallImage(context.settings, 32, 16, 4));
        const std::string what = "floor of roughness " + shortText(double{roughness}) + " at 89 degrees";
        numbers.push_back(blackNumber(what, seen));
        numbers.push_back(nonFiniteNumber(what, seen));
    }
    Scene scene;
    addMesh(scene, smoothBall(addMaterial(scene, metal(0.9f, 0.0f)), 1.0f, glm::vec3(0.0f), 4));
    scene.environment = constantEnvironment(1.0f);
    lookAt(scene, {0.0f, 0.0f, 4.0f}, glm::vec3(0.0f), 0.6f);
    numbers.push_back(blackNumber("mirror ball of 4 x 8 with smooth normals",
                                  see(context, scene, smallImage(context.settings, 64, 16, 8))));
    return numbers;
}

std::vector<Number> measureNormalTangentTest(const Context& context) {
    const Scene scene =
        importScene(context.sceneFile("gltf-features/NormalTangentTest/glTF-Binary/NormalTangentTest.glb"));
    RenderSettings settings = smallImage(context.settings, context.quick ? 64 : 128, 32, 8);
    settings.environment = "white";
    const Seen seen = see(context, scene, settings);
    return {blackNumber("NormalTangentTest", seen), nonFiniteNumber("NormalTangentTest", seen)};
}

std::vector<Number> measureCorridor(const Context& context) {
    std::vector<Number> numbers;
    for (const int depth : {4, 10, 25}) {
        RenderSettings settings = smallImage(context.settings, 8, 4, depth);
        settings.rouletteDepth = depth;
        const double mean = estimateOf(renderFilm(context, corridor(), settings)).mean, exact = corridorRadiance(depth);
        numbers.push_back({"error of mirrors of .9 at depth " + std::to_string(depth), std::abs(mean / exact - 1.0),
                           1e-4, "of exact", shortText(mean) + ", exactly " + shortText(exact), std::nullopt});
    }
    std::vector<glm::dvec2> times = timesByDepth(context);
    Number exponent{"exponent of time over depth in a corridor of mirrors",     logSlope(times), kNoLimit, "",
                    "1: linear; shown, for other work on the machine moves it", std::nullopt};
    exponent.plot = Plot{"depth", "seconds", true, true, {{"", std::move(times)}}};
    numbers.push_back(std::move(exponent));
    return numbers;
}

std::vector<Number> measureGlass(const Context& context) {
    std::vector<Number> numbers;
    for (const GlassScene& glassScene : glassScenes()) measureGlassScene(context, glassScene, numbers);
    return numbers;
}

std::vector<Number> measureNearlySpecular(const Context& context) {
    std::vector<Number> numbers;
    const double mirror = metalFloor(context, 0.0).mean;
    PlotSeries ratios{"", {}};
    for (const double alpha : {1e-1, 1e-2, 1e-3, 1e-4}) {
        const double rough = metalFloor(context, alpha).mean;
        ratios.points.emplace_back(alpha, rough / mirror);
        if (alpha > 1e-3) continue;
        numbers.push_back({"GGX of alpha " + shortText(alpha) + " against the mirror", std::abs(rough / mirror - 1.0),
                           0.01, "of the mirror's", shortText(rough) + ", mirror " + shortText(mirror), std::nullopt});
    }
    numbers.back().plot = Plot{"alpha", "radiance over the mirror's", true, false, {std::move(ratios)}};
    return numbers;
}

std::vector<Number> measureManyLights(const Context& context) {
    std::vector<Number> numbers;
    Estimate one;
    PlotSeries ratios{"", {}};
    for (const uint32_t count : {1u, 100u, 10'000u}) {
        const Stopwatch watch;
        const Estimate estimate =
            estimateOf(renderFilm(context, manyLights(count), smallImage(context.settings, 16, 16, 1)));
        if (count == 1) one = estimate;
        ratios.points.emplace_back(count, estimate.mean / one.mean);
        // Where nothing is random but the place within the pixel, rounding is left.
        const double sigma = std::hypot(estimate.standardError, one.standardError) + 1e-5 * one.mean;
        numbers.push_back({std::to_string(count) + " lights of one power", std::abs(estimate.mean - one.mean) / sigma,
                           4.0, "sigma", shortText(estimate.mean) + " in " + shortText(watch.seconds()) + " s",
                           std::nullopt});
    }
    numbers.back().plot = Plot{"lights", "radiance over that of one", true, false, {std::move(ratios)}};
    return numbers;
}

}  // namespace raylab::stability
