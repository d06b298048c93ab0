#include <cmath>

#include "engine/scene/sky.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// The sun of a computed sky as a directional light, for the integrators that take no light from a map.
namespace raylab::support {
namespace {

using SkyLight = GpuTest;

constexpr double kAlbedo = 0.6;

SkyDescription afternoon() { return {0.7f, 2.1f, 3.0f, 0.8f}; }

double solidAngle(int row, const Bitmap& map) {
    return 2.0 * kPi / map.width * (std::cos(kPi * row / map.height) - std::cos(kPi * (row + 1) / map.height));
}

/// What the map gives within a degree of the sun (x) and, without that, as a mean over the sphere (y), one channel.
glm::dvec2 partsOf(const SkyDescription& sky, int channel) {
    const Bitmap map = makeSky(sky).radiance;
    const glm::dvec3 sun(skyDirection(sky.sunElevationRadians, sky.sunAzimuthRadians));
    double near = 0.0, far = 0.0;
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            const double theta = kPi * (row + 0.5) / map.height, phi = 2.0 * kPi * ((column + 0.5) / map.width - 0.5);
            const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
            const double value = solidAngle(row, map) * static_cast<double>(map.at(column, row)[channel]);
            (glm::dot(d, sun) > std::cos(glm::radians(1.0)) ? near : far) += value;
        }
    return {near, far / (4.0 * kPi)};
}

/// The origin of a floor below the sky, seen from above.
FilmImage floorUnder(Device& device, const std::string& integrator, double ambient, bool inShadow) {
    Scene scene;
    scene.sky = afternoon();
    addMesh(scene, floorQuad(addMaterial(scene, lambert(static_cast<float>(kAlbedo))), 5.0f));
    const glm::vec3 sun = skyDirection(scene.sky->sunElevationRadians, scene.sky->sunAzimuthRadians);
    if (inShadow) addMesh(scene, box(0, 2.0f * sun - 0.3f, 2.0f * sun + 0.3f));
    lookAtPoint(scene, {0.5f, 3.0f, 0.2f}, glm::vec3(0.0f));
    RenderSettings settings = smallImage(8, 2, 4);
    settings.integrator = integrator;
    settings.ambient = ambient;
    return renderFilm(device, scene, settings);
}

/// E = sun irradiance x cosine, over pi times the albedo; the degree around it has a 2,000th of its light.
TEST_F(SkyLight, TheSunIsADirectionalLight) {
    glm::dvec3 lit;
    for (int c = 0; c < 3; ++c)
        lit[c] =
            kAlbedo / kPi * partsOf(afternoon(), c).x * std::sin(static_cast<double>(afternoon().sunElevationRadians));
    for (const char* integrator : {"whitted", "direct"}) {
        expectEveryPixel(floorUnder(device_, integrator, 0.0, false), lit, 1e-3, integrator);
        expectEveryPixel(floorUnder(device_, integrator, 0.0, true), 0.0, 0.0, integrator);
    }
}

TEST_F(SkyLight, TheRestOfTheSkyIsAmbient) {
    glm::dvec3 ambient;
    for (int c = 0; c < 3; ++c) ambient[c] = kAlbedo * partsOf(afternoon(), c).y;
    for (const char* integrator : {"whitted", "direct"})
        expectEveryPixel(floorUnder(device_, integrator, -1.0, true), ambient, 1e-2, integrator);
}

}  // namespace
}  // namespace raylab::support
