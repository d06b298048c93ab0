#include <algorithm>
#include <cmath>

#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

using EnvironmentLight = GpuTest;

/// A white Lambertian plane, facing up, whose radiance is the irradiance over pi.
FilmImage whitePlane(Device& device, const Environment& environment, int64_t spp) {
    Scene scene;
    scene.environment = environment;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(1.0f)), 10.0f));
    lookAtPoint(scene, {1.0f, 1.0f, 0.5f}, glm::vec3(0.0f));
    return renderFilm(device, scene, smallImage(16, spp, 1));
}

/// A13: radiance a + b w_y gives E = pi a + 2 pi b / 3. The map's columns are constant, so its interpolation adds less
/// than 1e-4.
TEST_F(EnvironmentLight, LinearGradient) {
    const Environment gradient = environmentOf(256, 128, [](glm::dvec3 d) { return 1.0 + 0.5 * d.y; });
    expectExact(whitePlane(device_, gradient, 1024), 1.0 + 2.0 * 0.5 / 3.0);
}

/// Irradiance of an upward plane by the midpoint rule over the bilinear map, `steps` squared points a texel.
double irradiance(const Bitmap& map, int steps) {
    const auto texel = [&](int x, int y) {
        return static_cast<double>(map.at((x + map.width) % map.width, std::clamp(y, 0, map.height - 1))[0]);
    };
    const int w = map.width * steps, h = map.height * steps;
    double sum = 0.0;
    for (int j = 0; j < h / 2; ++j) {  // the upper hemisphere
        const double y = (j + 0.5) / steps - 0.5, fy = y - std::floor(y), theta = kPi * (j + 0.5) / h;
        const int y0 = static_cast<int>(std::floor(y));
        for (int i = 0; i < w; ++i) {
            const double x = (i + 0.5) / steps - 0.5, fx = x - std::floor(x);
            const int x0 = static_cast<int>(std::floor(x));
            const double upper = (1.0 - fx) * texel(x0, y0) + fx * texel(x0 + 1, y0);
            const double lower = (1.0 - fx) * texel(x0, y0 + 1) + fx * texel(x0 + 1, y0 + 1);
            sum += ((1.0 - fy) * upper + fy * lower) * std::cos(theta) * std::sin(theta);
        }
    }
    return sum * (kPi / h) * (2.0 * kPi / w);
}

/// One texel gives nearly all the light. Sampling in proportion to the map keeps the relative deviation of a sample
/// near 1; without it a sample would find the texel once in two thousand, a deviation of about 40. Texels in the column
/// of the seam and in the first row check the wrapping and the pole.
TEST_F(EnvironmentLight, OneBrightTexel) {
    for (const glm::ivec2 bright : {glm::ivec2(20, 7), glm::ivec2(0, 7), glm::ivec2(63, 0)}) {
        Environment environment = environmentOf(64, 32, [](glm::dvec3) { return 0.05; });
        for (int c = 0; c < 3; ++c) environment.radiance.at(bright.x, bright.y)[c] = 5000.0f;
        const FilmImage film = whitePlane(device_, environment, 1024);
        const std::string what = "texel " + std::to_string(bright.x) + ", " + std::to_string(bright.y);
        expectExact(film, irradiance(environment.radiance, 32) / kPi, what);
        const Estimate estimate = estimateOf(film);
        const double samples = 16.0 * 16.0 * 1024.0;
        EXPECT_LE(estimate.standardError * std::sqrt(samples), 1.0 * estimate.mean) << what;
    }
}

}  // namespace
}  // namespace raylab::support
