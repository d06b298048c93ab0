#include <algorithm>
#include <cmath>
#include <set>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/measure/difference_map.h"
#include "engine/measure/image_error.h"
#include "engine/measure/stability/cases.h"
#include "engine/measure/stability/ray_sets.h"
#include "engine/measure/stability/render_case.h"
#include "engine/render/lighting.h"
#include "engine/render/ray_caster.h"
#include "engine/render/renderer.h"
#include "engine/render/tracer.h"
#include "engine/scene/import.h"

namespace raylab::stability {
namespace {

/// A box with a lamp, a metal and a glass ball.
Scene roomScene() {
    Scene scene;
    const uint32_t white = addMaterial(scene, lambert(0.7f)), light = addMaterial(scene, lamp(8.0f));
    addMesh(scene, floorQuad(white, 1.0f));
    addMesh(scene, ceilingQuad(white, 1.0f, 2.0f));
    addMesh(scene, quad(white, {-1, 0, -1}, {1, 0, -1}, {1, 2, -1}, {-1, 2, -1}));
    addMesh(scene, ceilingQuad(light, 0.3f, 1.99f));
    Material metal;
    metal.metallic = 1.0f;
    metal.roughness = 0.2f;
    addMesh(scene, meshOf(sphere(0.35f, 12, 24, {-0.4f, 0.36f, 0.0f}), addMaterial(scene, metal)));
    addMesh(scene, meshOf(sphere(0.3f, 12, 24, {0.45f, 0.31f, 0.2f}), addMaterial(scene, glass())));
    lookAt(scene, {0.0f, 1.0f, 3.5f}, {0.0f, 0.9f, 0.0f}, 0.7f);
    return scene;
}

Number differenceNumber(const std::string& what, const FilmImage& a, const FilmImage& b) {
    size_t different = 0;
    for (size_t i = 0; i < a.mean.pixels.size(); ++i) different += a.mean.pixels[i] == b.mean.pixels[i] ? 0u : 1u;
    Number number =
        countOf("values that differ: " + what, different, "values", "of " + std::to_string(a.mean.pixels.size()));
    if (!number.passes()) number.picture = heatPicture(relativeDifference(a.mean, b.mean), 0.0, 0.01);
    return number;
}

Bitmap varianceOfMean(const FilmImage& film) {
    Bitmap variance = film.variance;
    for (size_t i = 0; i < variance.pixels.size(); ++i) variance.pixels[i] /= film.samples.pixels[i / 3];
    return variance;
}

struct LitScene {
    std::string what;
    Scene scene;
    bool lit;  ///< some light reaches the image
};

Scene floorBelowCamera(float half) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.8f)), half));
    lookAt(scene, {1.0f, 2.0f, 3.0f}, glm::vec3(0.0f), 0.8f);
    return scene;
}

LitScene lampWithoutArea(bool besideOther) {
    Scene scene = floorBelowCamera(2.0f);
    const uint32_t material = addMaterial(scene, lamp(10.0f, true));
    TestMesh needle;
    needle.add({0, 1, 0}, {1, 1, 0}, {0.5f, 1, 0});
    needle.add({0, 1, 0}, {0, 1, 0}, {0, 1, 0});
    addMesh(scene, meshOf(needle, material));
    if (besideOther) addMesh(scene, ceilingQuad(material, 0.3f, 1.5f));
    return {besideOther ? "lamp without area beside another" : "lamp without area", std::move(scene), besideOther};
}

/// A point light exactly on a surface, and lamps that share edges and planes with what they light.
LitScene lightsOnSurfaces() {
    Scene scene = floorBelowCamera(2.0f);
    addMesh(scene, floorQuad(addMaterial(scene, lamp(3.0f, true)), 0.5f));
    addMesh(scene, quad(1, {0.5f, 0, 0.5f}, {0.5f, 0, -0.5f}, {0.5f, 1, -0.5f}, {0.5f, 1, 0.5f}));
    Light onFloor;
    onFloor.position = {-1.0f, 0.0f, 0.0f};
    scene.lights = {onFloor};
    lookAt(scene, {-1.0f, 2.0f, 3.0f}, glm::vec3(0.0f), 0.8f);
    return {"lights on surfaces", std::move(scene), true};
}

/// Nothing of a light that a closed box of black surrounds reaches the plane.
LitScene lightInsideABox() {
    Scene scene = floorBelowCamera(3.0f);
    addMesh(scene, box(addMaterial(scene, lambert(0.0f)), {-0.5f, 0.5f, -0.5f}, {0.5f, 1.5f, 0.5f}));
    Light enclosed;
    enclosed.position = {0.1f, 1.0f, 0.2f};
    enclosed.intensity = glm::vec3(100.0f);
    scene.lights = {enclosed};
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(50.0f, true)), 0.2f, 1.2f));
    lookAt(scene, {1.0f, 2.0f, 4.0f}, glm::vec3(0.0f), 0.8f);
    return {"lights inside a closed box", std::move(scene), false};
}

/// Camera inside a ball of glass inside a smooth, tight metal box with a lamp.
LitScene cameraInsideGlass() {
    Scene scene;
    Mesh ball = meshOf(sphere(1.0f, 16, 32, glm::vec3(0.0f)), addMaterial(scene, glass()));
    for (const glm::vec3& p : ball.positions) ball.normals.push_back(glm::normalize(p));
    addMesh(scene, std::move(ball));
    Material metal;
    metal.metallic = 1.0f;
    metal.roughness = 0.05f;
    addMesh(scene, box(addMaterial(scene, metal), glm::vec3(-1.0f), glm::vec3(1.0f)));
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(5.0f)), 0.4f, 0.999f));
    lookAt(scene, {0.1f, 0.0f, 0.2f}, {0.0f, 1.0f, 0.0f}, 1.5f);
    return {"camera inside glass", std::move(scene), true};
}

/// Texels, normals and coordinates that are legal but extreme.
LitScene extremeValues() {
    Scene scene;
    Material material;
    material.roughness = 0.0f;
    Mesh mesh = floorQuad(addMaterial(scene, material), 1e15f);
    mesh.normals = {{1, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
    addMesh(scene, std::move(mesh));
    scene.environment = environmentOf(8, 4, [](const glm::dvec3& d) { return d.y > 0.5 ? 1e30 : 1e-30; });
    lookAt(scene, {0.0f, 1.0f, 0.0f}, {1.0f, 0.9f, 0.0f}, 0.8f);
    return {"texels of 1e30, a floor of 1e15", std::move(scene), true};
}

LitScene negativeLight() {
    Scene scene = floorBelowCamera(2.0f);
    Light light, negative;
    light.position = {0.0f, 1.0f, 0.0f};
    negative.position = {0.5f, 1.0f, 0.0f};
    negative.intensity = glm::vec3(-0.5f);
    scene.lights = {light, negative};
    return {"a light of negative intensity", std::move(scene), true};
}

/// Non-finite pixels, and whether light is where it should be and nowhere else; of the kernel that the scene needs, and
/// of the one with everything.
void measureFinite(const Context& context, const LitScene& lit, std::vector<Number>& numbers) {
    Number nonFinite =
        countOf("pixels with a sample that is not finite: " + lit.what, 0, "pixels", "of 256 in each image");
    Number wrongLight =
        countOf(std::string(lit.lit ? "images without light: " : "images with light: ") + lit.what, 0, "images", "");
    for (const char* needs : {"scene", "full"}) {
        if (context.quick && std::string_view(needs) == "full") continue;
        RenderSettings settings = smallImage(context.settings, 16, 32, 8);
        settings.needs = needs;
        const FilmImage film = renderFilm(context, lit.scene, settings);
        nonFinite.value += static_cast<double>(film.nonFinitePixels);
        wrongLight.value += (estimateOf(film).mean > 0.0) == lit.lit ? 0.0 : 1.0;
        showImage(nonFinite, lit.scene, settings, film);
        showImage(wrongLight, lit.scene, settings, film);
    }
    numbers.push_back(std::move(nonFinite));
    numbers.push_back(std::move(wrongLight));
}

/// Pixels with a channel that is further apart than a ten-thousandth.
size_t differentPixels(const Bitmap& a, const Bitmap& b) {
    std::set<size_t> different;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        if (std::abs(a.pixels[i] - b.pixels[i]) > 1e-4f * std::abs(b.pixels[i])) different.insert(i / 3);
    return different.size();
}

/// The context's tracer against another one: by the same paths, where what differs is a hit, and by others, since the
/// same would hide a difference of the means.
std::vector<Number> measureAgainst(const Context& context, const std::string& tracer) {
    const std::string missing = missingForTracer(tracer, context.device.description());
    if (!missing.empty()) throw Skipped("the device lacks " + missing);
    const Scene scene = roomScene();
    RenderSettings settings = smallImage(context.settings, 32, 64, 6);
    const FilmImage ours = renderFilm(context, scene, settings);
    settings.tracer = tracer;
    const FilmImage same = renderFilm(context, scene, settings);
    settings.seed += 1;
    const FilmImage theirs = renderFilm(context, scene, settings);
    const ZTest test = zTest(ours.mean, varianceOfMean(ours), theirs.mean, varianceOfMean(theirs));
    Number z{"pixels that fail the Z-test against " + tracer,
             1.0 - test.passFraction,
             0.0025,
             "of pixels",
             "of " + std::to_string(test.pixels) + ", other seeds, .01 with Sidak's correction",
             std::nullopt};
    if (!z.passes()) z.picture = heatPicture(zScores(ours, theirs), 0.0, 8.0);
    Number paths{
        "pixels that differ from " + tracer + " on the same paths",
        static_cast<double>(differentPixels(ours.mean, same.mean)),
        kNoLimit,
        "pixels",
        "of " + std::to_string(test.pixels) + ", by more than 1e-4: hits at other places or on other triangles",
        std::nullopt};
    paths.picture = heatPicture(relativeDifference(ours.mean, same.mean), 0.0, 0.01);
    return {std::move(z), std::move(paths)};
}

/// Traces and renders a little by each tracer that the device runs.
void exercise(Device& device) {
    const Scene scene = roomScene();
    for (const std::string& tracer : tracerNames()) {
        if (!missingForTracer(tracer, device.description()).empty()) continue;
        RenderSettings settings = smallImage({}, 16, 4, 4);
        settings.tracer = tracer;
        renderFilm(device, scene, settings);
        RayCaster caster(device, scene, settings);
        caster.closest(randomRays(scene, 1000, 231));
    }
}

}  // namespace

std::vector<Number> measureDegenerateLights(const Context& context) {
    std::vector<Number> numbers;
    for (const LitScene& lit :
         {lampWithoutArea(false), lampWithoutArea(true), lightsOnSurfaces(), lightInsideABox(), cameraInsideGlass()})
        measureFinite(context, lit, numbers);
    return numbers;
}

std::vector<Number> measureExtremeValues(const Context& context) {
    std::vector<Number> numbers;
    for (const LitScene& lit : {extremeValues(), negativeLight()}) measureFinite(context, lit, numbers);
    return numbers;
}

std::vector<Number> measureDeterminism(const Context& context) {
    const Scene scene = roomScene();
    const RenderSettings settings = smallImage(context.settings, 32, 16, 6);
    const FilmImage first = renderFilm(context, scene, settings);
    std::vector<Number> numbers = {differenceNumber("the same again", first, renderFilm(context, scene, settings))};
    for (const double slice : {1.0, 400.0}) {
        RenderSettings other = settings;
        other.sliceMs = slice;
        numbers.push_back(differenceNumber("dispatches of " + std::to_string(static_cast<int>(slice)) + " ms", first,
                                           renderFilm(context, scene, other)));
    }
    return numbers;
}

std::vector<Number> measureAgainstQuery(const Context& context) { return measureAgainst(context, "query"); }

std::vector<Number> measureAgainstPipeline(const Context& context) { return measureAgainst(context, "pipeline"); }

std::vector<Number> measureValidation(const Context& context) {
    const double before = context.device.validationMessageCount();
    try {
        Device device({std::to_string(context.device.description().index), true});
        exercise(device);
        return {{"messages of core and synchronisation validation", before + device.validationMessageCount(), 0.0,
                 "messages", "every tracer renders and traces", std::nullopt}};
    } catch (const Error& error) {
        throw Skipped(error.what());
    }
}

std::vector<Number> measureSlowDispatch(const Context& context) {
    Scene scene = importScene(context.sceneFile("victorian-house/house.glb"));
    RenderSettings settings = context.settings;
    settings.width = context.quick ? 960 : 3840;
    settings.height = context.quick ? 540 : 2160;
    settings.spp = 1;
    settleEnvironment(scene, settings);
    Renderer renderer(context.device, scene, settings);
    const Stopwatch watch;
    PlotSeries steps{"", {}, false};
    double before = 0.0;
    while (watch.seconds() < (context.quick ? 5.0 : 60.0) && renderer.step()) {
        context.check();
        steps.points.emplace_back(watch.seconds(), 1e3 * (renderer.times().device - before));
        before = renderer.times().device;
    }
    Number number{
        "longest submission, the house at " + std::to_string(settings.width) + " x " + std::to_string(settings.height),
        renderer.times().longestDispatch,
        1.0,
        "s",
        std::to_string(static_cast<int>(settings.sliceMs)) + " ms are aimed at",
        std::nullopt};
    number.plot = Plot{"seconds since the start", "ms of a step", false, true, {std::move(steps)}};
    return {std::move(number)};
}

}  // namespace raylab::stability
