#include <algorithm>
#include <cmath>

#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

using Lights = GpuTest;

constexpr float kFloorAlbedo = 0.6f;
constexpr double kRadiancePerIrradiance = 0.6 / kPi;

/// A Lambertian plane at y = 0.
Scene planeScene() {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(kFloorAlbedo)), 3.0f));
    return scene;
}

/// Radiance of one point of the plane, seen from the side so that nothing is in the way.
FilmImage viewPoint(Device& device, Scene scene, glm::vec3 point, int64_t spp) {
    lookAtPoint(scene, point + glm::vec3(3.0f, 0.4f, 1.0f), point);
    return renderFilm(device, scene, smallImage(8, spp, 1));
}

/// A3. One light and one point: no variance, so every pixel is exact.
TEST_F(Lights, PointLightFallsOffByCosineAndSquare) {
    const glm::dvec3 intensity(10.0, 20.0, 5.0);
    double overhead[2] = {};
    for (int i = 0; i < 2; ++i) {
        const double height = 1.5 * (i + 1);
        Scene scene = planeScene();
        Light light;
        light.position = {0.0f, static_cast<float>(height), 0.0f};
        light.intensity = glm::vec3(intensity);
        scene.lights = {light};
        const FilmImage film = viewPoint(device_, scene, glm::vec3(0.0f), 4);
        expectEveryPixel(film, kRadiancePerIrradiance * intensity / (height * height), 2e-5, "below");
        overhead[i] = estimateOf(film).mean;
        const double d = std::hypot(2.0, height);
        expectEveryPixel(viewPoint(device_, scene, {0.0f, 0.0f, -2.0f}, 4),
                         kRadiancePerIrradiance * intensity * (height / d) / (d * d), 1e-4, "aside");
    }
    EXPECT_NEAR(overhead[0] / overhead[1], 4.0, 1e-4);
}

TEST_F(Lights, DirectionalLightFollowsTheCosine) {
    Scene scene = planeScene();
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = glm::normalize(glm::vec3(1.0f, -1.0f, 0.5f));
    sun.intensity = {3.0f, 2.0f, 1.0f};
    scene.lights = {sun};
    const double cosine = 1.0 / std::sqrt(1.0 + 1.0 + 0.25);
    expectEveryPixel(viewPoint(device_, scene, {1.0f, 0.0f, 1.0f}, 4),
                     kRadiancePerIrradiance * cosine * glm::dvec3(3.0, 2.0, 1.0), 1e-5);
}

/// KHR_lights_punctual: full inside the inner cone, nothing outside the outer one, a squared ramp of the cosine
/// between.
TEST_F(Lights, SpotLightHasItsCone) {
    Scene scene = planeScene();
    Light spot;
    spot.kind = LightKind::spot;
    spot.position = {0.0f, 2.0f, 0.0f};
    spot.intensity = glm::vec3(8.0f);
    spot.innerConeRadians = 0.3f;
    spot.outerConeRadians = 0.6f;
    scene.lights = {spot};
    for (const double angle : {0.25, 0.45, 0.65}) {
        const double ramp = (std::cos(angle) - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
        const double falloff = std::pow(std::clamp(ramp, 0.0, 1.0), 2.0);
        const double cosine = std::cos(angle), d = 2.0 / cosine;
        expectEveryPixel(viewPoint(device_, scene, {2.0 * std::tan(angle), 0.0, 0.0}, 4),
                         kRadiancePerIrradiance * 8.0 * falloff * cosine / (d * d), 2e-4,
                         "angle " + std::to_string(angle));
    }
}

/// Two point lights, a directional one and a lamp together: what is chosen at random must not change the sum.
TEST_F(Lights, SeveralKindsAddUp) {
    Scene scene = planeScene();
    Light one, two, sun;
    one.position = {0.0f, 2.0f, 0.0f};
    one.intensity = glm::vec3(4.0f);
    two.position = {-1.0f, 1.0f, 0.0f};
    two.intensity = glm::vec3(1.0f);
    sun.kind = LightKind::directional;
    sun.direction = {0.8f, -0.6f, 0.0f};
    scene.lights = {one, two, sun};
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(2.0f)), 0.5f, 5.0f));
    const double sine = 0.5 / std::hypot(0.5, 5.0);
    const double square = 4.0 * sine * std::atan(sine) / kPi;  // form factor, as in A5
    const double irradiance = 4.0 / 4.0 + 1.0 / (2.0 * std::sqrt(2.0)) + 0.6 + kPi * 2.0 * square;
    expectExact(viewPoint(device_, scene, glm::vec3(0.0f), 8192), kRadiancePerIrradiance * irradiance);
}

/// A4: disc of radius 1 at height 1.5; 256 edges take 1e-4 off its area.
TEST_F(Lights, DiscLight) {
    Scene scene = planeScene();
    Mesh disc;
    disc.material = addMaterial(scene, lamp(3.0f));
    disc.positions = {{0.0f, 1.5f, 0.0f}};
    constexpr uint32_t kEdges = 256;
    for (uint32_t i = 0; i < kEdges; ++i) {
        const double phi = 2.0 * kPi * i / kEdges;
        disc.positions.emplace_back(std::cos(phi), 1.5, std::sin(phi));
        disc.triangles.emplace_back(0u, 1u + i, 1u + (i + 1) % kEdges);
    }
    addMesh(scene, std::move(disc));
    const double exact = kRadiancePerIrradiance * kPi * 3.0 / (1.0 + 1.5 * 1.5);
    expectExact(viewPoint(device_, scene, glm::vec3(0.0f), 1024), exact);
}

/// A5: the point is below the middle of the square.
TEST_F(Lights, SquareLight) {
    Scene scene = planeScene();
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(3.0f)), 0.5f, 1.0f));
    expectExact(viewPoint(device_, scene, glm::vec3(0.0f), 1024), kRadiancePerIrradiance * 0.752275 * 3.0);
}

/// Mirrored, a floor becomes a ceiling, and its front goes along (glTF 2.0, section 3.7.4).
TEST_F(Lights, MirroredLampKeepsItsFront) {
    Scene scene = planeScene();
    glm::mat4 upsideDown(1.0f);
    upsideDown[1][1] = -1.0f;
    addMesh(scene, floorQuad(addMaterial(scene, lamp(3.0f)), 0.5f, -1.0f), upsideDown);
    expectExact(viewPoint(device_, scene, glm::vec3(0.0f), 1024), kRadiancePerIrradiance * 0.752275 * 3.0);
}

/// Emits where the texture is white: u below 1/2. Filtering mixes the two in one texel of 64.
Scene halfLampScene() {
    Scene scene = planeScene();
    Texture half;
    half.width = half.height = 64;
    half.wrapU = half.wrapV = Wrap::clamp;
    for (uint32_t i = 0; i < 64 * 64; ++i) half.texels.push_back(i % 64 < 32 ? 0xffffffffu : 0xff000000u);
    scene.textures = {half};
    Material material = lamp(3.0f);
    material.emissionTexture = 0;
    addMesh(scene, ceilingQuad(addMaterial(scene, material), 0.5f, 1.0f));
    return scene;
}

/// Form factor of a differential surface to a rectangle that faces it at distance 1, a and b its sides, one corner
/// above the point (Siegel, Howell, "Thermal Radiation Heat Transfer", configuration 4).
double cornerFactor(double a, double b) {
    const double p = std::sqrt(1.0 + a * a), q = std::sqrt(1.0 + b * b);
    return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * kPi);
}

/// Below the middle of the white half.
TEST_F(Lights, TexturedLampLightsByItsTexture) {
    EXPECT_NEAR(4.0 * cornerFactor(0.5, 0.5), 0.239456, 1e-6) << "A5";
    expectExact(viewPoint(device_, halfLampScene(), {-0.25f, 0.0f, 0.0f}, 4096),
                kRadiancePerIrradiance * kPi * 3.0 * 4.0 * cornerFactor(0.25, 0.5));
}

TEST_F(Lights, TexturedLampLooksLikeItsTexture) {
    Scene scene = halfLampScene();
    for (const float x : {-0.25f, 0.25f}) {
        lookAtPoint(scene, {x, 0.5f, 0.0f}, {x, 1.0f, 0.0f});
        expectEveryPixel(renderFilm(device_, scene, smallImage(8, 4, 0)), x < 0.0f ? 3.0 : 0.0, 1e-5,
                         "x " + std::to_string(x));
    }
}

/// A6: the image is exactly the receiving unit square, seen from a point half a unit above it; its mean is the form
/// factor of the two squares.
TEST_F(Lights, UnitSquaresHaveTheirFormFactors) {
    const std::pair<double, Mesh> lamps[] = {
        {0.199825, ceilingQuad(1, 0.5f, 1.0f)},
        {0.200044, quad(1, {-0.5f, 0, -0.5f}, {0.5f, 0, -0.5f}, {0.5f, 1, -0.5f}, {-0.5f, 1, -0.5f})}};
    for (const auto& [factor, lampMesh] : lamps) {
        Scene scene = planeScene();
        addMaterial(scene, lamp(1.0f));
        addMesh(scene, lampMesh);
        lookDown(scene, 0.5f);
        expectExact(renderFilm(device_, scene, smallImage(16, 1024, 1)), kRadiancePerIrradiance * kPi * factor);
    }
}

/// A7: sphere of radius 0.5 at distance 2, 60 degrees from the normal; 200 by 100 facets take 3e-4 off.
TEST_F(Lights, SphereLight) {
    Scene scene = planeScene();
    const glm::vec3 centre(-2.0f * std::sqrt(0.75f), 1.0f, 0.0f);
    addMesh(scene, meshOf(accel_test::sphere(0.5f, 100, 200, centre), addMaterial(scene, lamp(5.0f))));
    expectExact(viewPoint(device_, scene, glm::vec3(0.0f), 10000), kRadiancePerIrradiance * kPi * 5.0 / 16.0 * 0.5);
}

}  // namespace
}  // namespace raylab::support
