#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// Spheres, discs, rectangles and the sun's disc that are lights, not surfaces.
namespace raylab::support {
namespace {

using LightShapes = GpuTest;

constexpr double kAlbedo = 0.6;
constexpr double kRadiance = 3.0;

/// A light that sends kRadiance.
Light shaped(LightKind kind, glm::vec3 position, double sizeOrRadius) {
    Light light;
    light.kind = kind;
    light.position = position;
    light.radius = static_cast<float>(sizeOrRadius);
    light.size = glm::vec2(static_cast<float>(sizeOrRadius));
    const double area = kind == LightKind::rectangle ? sizeOrRadius * sizeOrRadius : kPi * sizeOrRadius * sizeOrRadius;
    light.intensity = glm::vec3(static_cast<float>(kRadiance * area));
    return light;
}

/// The sun at the zenith with the irradiance 1.
Light sunDisc(double angularRadius) {
    Light sun;
    sun.kind = LightKind::directional;
    sun.angularRadiusRadians = static_cast<float>(angularRadius);
    return sun;
}

/// The origin of a Lambertian floor.
FilmImage floorUnder(Device& device, const std::vector<Light>& lights, const std::string& choice, int64_t spp) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(static_cast<float>(kAlbedo))), 0.5f));
    scene.lights = lights;
    lookAtPoint(scene, {3.0f, 0.4f, 1.0f}, glm::vec3(0.0f));
    RenderSettings settings = smallImage(8, spp, 1);
    settings.lightChoice = choice;
    return renderFilm(device, scene, settings);
}

void expectIrradiance(Device& device, const std::vector<Light>& lights, double irradiance, const std::string& what,
                      const std::string& choice = "power", int64_t spp = 2048) {
    const double exact = kAlbedo / kPi * irradiance;
    const FilmImage film = floorUnder(device, lights, choice, spp);
    const Estimate estimate = estimateOf(film);
    std::printf("%-22s %.6f +- %.6f, exactly %.6f\n", what.c_str(), estimate.mean, estimate.standardError, exact);
    expectExact(film, exact, what);
}

/// A7: E = pi L (R/d)^2 cos t, for a sphere near and far, overhead and aside, wholly above the horizon.
TEST_F(LightShapes, Sphere) {
    for (const glm::dvec3 centre : {glm::dvec3(0, 1, 0), glm::dvec3(1.0, 1.5, -0.7), glm::dvec3(30, 40, 0)}) {
        const double radius = 0.5, d = glm::length(centre);
        expectIrradiance(device_, {shaped(LightKind::sphere, centre, radius)},
                         kPi * kRadiance * std::pow(radius / d, 2.0) * centre.y / d, "sphere at " + std::to_string(d));
    }
}

/// A4: E = pi L R^2 / (R^2 + h^2).
TEST_F(LightShapes, Disc) {
    for (const double h : {0.3, 20.0})
        expectIrradiance(device_, {shaped(LightKind::disc, {0.0, h, 0.0}, 0.8)},
                         kPi * kRadiance * 0.64 / (0.64 + h * h), "disc at " + std::to_string(h));
}

/// A5: the unit square above a point gives E = .752275 L; turned away, or below the floor, nothing.
TEST_F(LightShapes, Rectangle) {
    Light square = shaped(LightKind::rectangle, {0, 1, 0}, 1.0);
    expectIrradiance(device_, {square}, 0.752275 * kRadiance, "square");
    square.direction = {0, 1, 0};
    expectEveryPixel(floorUnder(device_, {square}, "power", 16), 0.0, 0.0, "turned away");
}

/// Several at once, whichever way they are chosen: the sum.
TEST_F(LightShapes, Together) {
    const double sum = kPi * kRadiance * 0.25 + kPi * kRadiance * 0.64 / (0.64 + 4.0) + 0.752275 * kRadiance + 1.0;
    Light point;
    point.position = {0.0f, 2.0f, 0.0f};
    point.intensity = glm::vec3(8.0f);
    const std::vector<Light> lights = {sunDisc(0.1), point, shaped(LightKind::sphere, {0, 1, 0}, 0.5),
                                       shaped(LightKind::disc, {0, 2, 0}, 0.8),
                                       shaped(LightKind::rectangle, {0, 1, 0}, 1.0)};
    for (const std::string choice : {"tree", "power"})
        expectIrradiance(device_, lights, sum + 8.0 / 4.0, "all by " + choice, choice, 8192);
}

/// The camera sees the radiance itself, and what lies behind a shape gets light that passed through it.
TEST_F(LightShapes, IsSeen) {
    for (const LightKind kind : {LightKind::sphere, LightKind::disc, LightKind::rectangle}) {
        Scene scene;
        addMesh(scene, floorQuad(addMaterial(scene, lamp(0.5f)), 5.0f));
        Light light = shaped(kind, {0, 1, 0}, 0.5);
        light.direction = {0, 1, 0};
        scene.lights = {light};
        lookAtPoint(scene, {0.1f, 3.0f, 0.05f}, {0.1f, 0.0f, 0.05f});
        scene.cameras[0].up = {0, 0, -1};
        expectEveryPixel(renderFilm(device_, scene, smallImage(4, 2, 1)), kRadiance + 0.5, 1e-5);
    }
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.0f)), 1.0f, -9.0f));
    scene.lights = {sunDisc(0.2)};
    lookAtPoint(scene, glm::vec3(0.0f), {0.15f, 1.0f, 0.0f});
    expectEveryPixel(renderFilm(device_, scene, smallImage(4, 2, 1)), 1.0 / (kPi * std::pow(std::sin(0.2), 2.0)), 1e-5);
}

/// A glossy floor under a square and under a disc in the sky, where rays that scatter come upon the light as often as
/// it is sampled: against a square of emissive triangles, and against scattering into a sky of the same radiance.
TEST_F(LightShapes, WeighsScatteredRays) {
    Material metal = lambert(0.9f);
    metal.metallic = 1.0f;
    metal.roughness = 0.4f;
    Estimate estimates[2];
    for (int i = 0; i < 2; ++i) {
        Scene scene;
        addMesh(scene, floorQuad(addMaterial(scene, metal), 2.0f));
        if (i == 0)
            scene.lights = {shaped(LightKind::rectangle, {0, 1, 0}, 1.0)};
        else
            addMesh(scene, ceilingQuad(addMaterial(scene, lamp(static_cast<float>(kRadiance))), 0.5f, 1.0f));
        lookAtPoint(scene, {1.2f, 1.5f, 0.3f}, glm::vec3(0.0f));
        estimates[i] = estimateOf(renderFilm(device_, scene, smallImage(16, 1024, 1)));
        std::printf("%s: %.5f +- %.5f\n", i == 0 ? "rectangle" : "triangles", estimates[i].mean,
                    estimates[i].standardError);
    }
    EXPECT_LE(std::abs(estimates[0].mean - estimates[1].mean),
              4.0 * std::hypot(estimates[0].standardError, estimates[1].standardError));
    EXPECT_LE(estimates[0].standardError, 0.003 * estimates[0].mean);
}

/// A11: the shadow of a half plane at height D under a sun of angular radius a is D 2 tan(a) wide, and across it the
/// share of the disc that is seen is (acos t - t sqrt(1 - t^2)) / pi.
TEST_F(LightShapes, PenumbraOfTheSun) {
    constexpr double kAngle = 0.533 / 2.0 * kPi / 180.0, kHeight = 4.0, kEye = 3.0;
    constexpr int kSize = 12;
    const double half = 1.2 * kHeight * std::tan(kAngle);  // of the view
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(static_cast<float>(kAlbedo))), 0.5f));
    addMesh(scene, quad(addMaterial(scene, lambert(0.0f)), {0, kHeight, 1}, {9, kHeight, 1}, {9, kHeight, -1},
                        {0, kHeight, -1}));
    scene.lights = {sunDisc(kAngle)};
    lookAt(scene, {0.0f, kEye, 0.0f}, glm::vec3(0.0f), static_cast<float>(2.0 * std::atan(half / kEye)));
    scene.cameras[0].up = {0, 0, -1};
    RenderSettings settings = smallImage(kSize, 4096, 1);
    settings.antialias = "1";
    const FilmImage film = renderFilm(device_, scene, settings);
    for (int x = 0; x < kSize; ++x) {
        const double t = std::clamp(1.2 * (2.0 * (x + 0.5) / kSize - 1.0), -1.0, 1.0);
        const double exact = kAlbedo / kPi * (std::acos(t) - t * std::sqrt(1.0 - t * t)) / kPi;
        double mean = 0.0, variance = 0.0;
        for (int y = 0; y < kSize; ++y) {
            mean += static_cast<double>(film.mean.at(x, y)[0]) / kSize;
            variance += static_cast<double>(film.variance.at(x, y)[0]) / (kSize * kSize * 4096.0);
        }
        std::printf("t %5.2f: %.6f +- %.6f, exactly %.6f\n", t, mean, std::sqrt(variance), exact);
        EXPECT_LE(std::abs(mean - exact), 4.0 * std::sqrt(variance) + 0.001 * kAlbedo / kPi) << "t " << t;
    }
}

/// Integrators of punctual lights alone take a shape as a point at its centre.
TEST_F(LightShapes, ArePointsToWhittedAndDirect) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(static_cast<float>(kAlbedo))), 1.0f));
    lookAtPoint(scene, {0.5f, 3.0f, 0.2f}, glm::vec3(0.0f));
    const glm::dvec3 centre(1.0, 2.0, 0.0);
    const double d2 = glm::dot(centre, centre), cosine = centre.y / std::sqrt(d2);
    double intensity = 0.0;  // towards the floor
    for (const LightKind kind : {LightKind::sphere, LightKind::disc, LightKind::rectangle}) {
        scene.lights.push_back(shaped(kind, centre, 0.5));
        intensity += static_cast<double>(scene.lights.back().intensity.x) * (kind == LightKind::sphere ? 1.0 : cosine);
    }
    for (const char* integrator : {"whitted", "direct"}) {
        RenderSettings settings = smallImage(4, 1, 1);
        settings.integrator = integrator;
        expectEveryPixel(renderFilm(device_, scene, settings), kAlbedo / kPi * intensity * cosine / d2, 1e-4,
                         integrator);
    }
}

}  // namespace
}  // namespace raylab::support
