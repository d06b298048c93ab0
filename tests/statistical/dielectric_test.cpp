#include <cmath>

#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

using Dielectric = GpuTest;

/// White above, black below.
Environment upperHalfWhite() {
    return environmentOf(64, 32, [](glm::dvec3 d) { return d.y > 0.0 ? 1.0 : 0.0; });
}

/// A8: all reflections between the two faces of a sheet add up to 2R / (1 + R), whether they are followed or summed.
void checkSheet(Device& device, const Mesh& sheet, const Material& material) {
    for (const double side : {1.0, -1.0}) {
        Scene scene;
        scene.environment = upperHalfWhite();
        addMaterial(scene, material);
        addMesh(scene, sheet);
        lookAtPoint(scene, {0.0, side * 5.0, 0.0}, glm::vec3(0.0f));
        expectExact(renderFilm(device, scene, smallImage(16, side > 0.0 ? 8192 : 512, 64)),
                    side > 0.0 ? 0.076923 : 0.923077, side > 0.0 ? "reflected" : "transmitted");
    }
}

TEST_F(Dielectric, SlabOfGlass) { checkSheet(device_, box(0, {-10.0f, -0.5f, -10.0f}, {10.0f, 0.5f, 10.0f}), glass()); }

TEST_F(Dielectric, ThinSheet) {
    Material sheet = glass();
    sheet.thin = true;
    checkSheet(device_, floorQuad(0, 10.0f), sheet);
}

/// A block of glass under a white sky, with a black sheet inside it that takes all light which enters.
Scene blackenedGlass() {
    Scene scene;
    scene.environment = constantEnvironment(1.0f);
    addMesh(scene, box(addMaterial(scene, glass()), {-10.0f, -2.0f, -10.0f}, {10.0f, 0.0f, 10.0f}));
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.0f)), 9.9f, -1.0f));
    return scene;
}

/// A8: the Fresnel equations at n = 1.5, published values; normal incidence is in the slab's.
TEST_F(Dielectric, FresnelReflectanceAtOneFace) {
    const std::pair<double, double> published[] = {
        {0.0, 0.04}, {45.0, 0.050240}, {60.0, 0.089187}, {75.0, 0.253061}, {85.0, 0.6128}};
    for (const auto& [degrees, reflectance] : published) {
        Scene scene = blackenedGlass();
        const double angle = degrees * kPi / 180.0;
        lookAtPoint(scene, {4.0 * std::sin(angle), 4.0 * std::cos(angle), 0.0}, glm::vec3(0.0f));
        const auto spp = static_cast<int64_t>(650.0 * (1.0 - reflectance) / reflectance) + 64;
        expectExact(renderFilm(device_, scene, smallImage(16, spp, 8)), reflectance,
                    std::to_string(degrees) + " degrees");
    }
}

/// From inside: radiance in the denser medium is larger by n^2 (Veach 1997, section 5.2), and past 41.81 degrees no
/// light comes in.
TEST_F(Dielectric, SeenFromInside) {
    for (const double degrees : {0.0, 40.0, 43.0}) {
        Scene scene = blackenedGlass();
        const double angle = degrees * kPi / 180.0;
        lookAtPoint(scene, {0.5 * std::sin(angle), -0.5 * std::cos(angle), 0.0}, glm::vec3(0.0f));
        double exact = 0.0;
        if (degrees < 41.0) {
            const double sinOut = 1.5 * std::sin(angle), cosOut = std::sqrt(1.0 - sinOut * sinOut),
                         cosIn = std::cos(angle);
            const double s = (1.5 * cosIn - cosOut) / (1.5 * cosIn + cosOut);
            const double p = (cosIn - 1.5 * cosOut) / (cosIn + 1.5 * cosOut);
            exact = 2.25 * (1.0 - 0.5 * (s * s + p * p));
        }
        expectExact(renderFilm(device_, scene, smallImage(16, 512, 8)), exact, std::to_string(degrees) + " degrees");
    }
}

}  // namespace
}  // namespace raylab::support
