#include <cmath>

#include "tests/support/estimate.h"
#include "whitted_support.h"

namespace raylab::support {
namespace {

/// Mirrored and refracted rays.
using WhittedBranches = GpuTest;

/// Two facing mirrors, open above: along a ray of this slope a camera between them sees the white sky in the image of
/// number `images`, half a width before the ray would be reflected once more.
Scene mirrorCorridor(const Material& mirror, int images) {
    constexpr float kSlope = 0.02f;
    const float top = kSlope * static_cast<float>(images);
    Scene scene;
    const uint32_t material = addMaterial(scene, mirror);
    addMesh(scene, quad(material, {0.5f, -1, -1}, {0.5f, -1, 1}, {0.5f, top, 1}, {0.5f, top, -1}));
    addMesh(scene, quad(material, {-0.5f, -1, 1}, {-0.5f, -1, -1}, {-0.5f, top, -1}, {-0.5f, top, 1}));
    scene.environment = constantEnvironment(1.0f);
    lookAtPoint(scene, {}, {1.0f, kSlope, 0.0f});
    return scene;
}

Material metal(float reflectance) {
    Material material;
    material.baseColor = glm::vec3(reflectance);
    material.metallic = 1.0f;
    material.roughness = 0.0f;
    return material;
}

Material fixedMirror(float share) {
    PhongMaterial phong;
    phong.diffuse = glm::vec3(0.0f);
    phong.mirror = glm::vec3(1.0f);
    phong.reflection = share;
    phong.ior = kOpaqueIor;
    return phongMaterial(phong);
}

/// A9, S16.
TEST_F(WhittedBranches, FacingMirrors) {
    const std::pair<int, double> published[] = {{4, 0.6561}, {10, 0.348678}, {25, 0.071790}};
    for (const auto& [images, radiance] : published) {
        RenderSettings settings = whitted(images);
        settings.environment = "auto";
        expectEveryPixel(renderFilm(device_, mirrorCorridor(metal(0.9f), images), settings), radiance, 2e-5);
        settings.reflection = "fixed";
        expectEveryPixel(renderFilm(device_, mirrorCorridor(fixedMirror(0.9f), images), settings), radiance, 2e-5);
        settings.depth = images - 1;
        expectEveryPixel(renderFilm(device_, mirrorCorridor(metal(0.9f), images), settings), 0.0, 0.0, "too deep");
    }
}

TEST_F(WhittedBranches, AsManyImagesAsTheDepthAllows) {
    RenderSettings settings = whitted(4);
    settings.environment = "auto";
    int count = 0;
    for (int images = 1; images <= 7; ++images)
        if (estimateOf(renderFilm(device_, mirrorCorridor(metal(0.9f), images), settings)).mean > 0.0) ++count;
    EXPECT_EQ(count, 4);
}

/// .9^6 = .53 counts, .9^7 = .48 does not.
TEST_F(WhittedBranches, ThresholdEndsAChain) {
    RenderSettings settings = whitted(100);
    settings.environment = "auto";
    settings.threshold = 0.5;
    expectEveryPixel(renderFilm(device_, mirrorCorridor(metal(0.9f), 6), settings), 0.531441, 1e-5);
    expectEveryPixel(renderFilm(device_, mirrorCorridor(metal(0.9f), 7), settings), 0.0, 0.0);
}

TEST_F(WhittedBranches, BeyondTheDepthLimitLiesNothingOrTheAverage) {
    RenderSettings settings = whitted(2);
    settings.environment = "auto";
    settings.ambient = 0.5;
    expectEveryPixel(renderFilm(device_, mirrorCorridor(metal(0.9f), 9), settings), 0.0, 0.0);
    settings.beyond = "average";
    expectEveryPixel(renderFilm(device_, mirrorCorridor(metal(0.9f), 9), settings), 0.729 * 0.5, 1e-5);
}

/// White above, black below, and a slab of clear glass between: seen from above or from below.
FilmImage viewSlab(Device& device, double side, const RenderSettings& settings) {
    Scene scene;
    scene.environment = environmentOf(64, 32, [](glm::dvec3 d) { return d.y > 0.0 ? 1.0 : 0.0; });
    addMesh(scene, box(addMaterial(scene, glass()), {-9, -0.5f, -9}, {9, 0.5f, 9}));
    lookAtPoint(scene, {0.0, side * 5.0, 0.0}, {});
    return renderFilm(device, scene, settings);
}

/// A8. Both branches of each hit are followed, so there is no noise and the two parts add up to 1.
TEST_F(WhittedBranches, SlabOfGlass) {
    RenderSettings settings = whitted(40);
    settings.environment = "auto";
    const FilmImage reflected = viewSlab(device_, 1.0, settings), transmitted = viewSlab(device_, -1.0, settings);
    expectEveryPixel(reflected, 0.076923, 1e-5);
    expectEveryPixel(transmitted, 0.923077, 1e-5);
    EXPECT_NEAR(estimateOf(reflected).mean + estimateOf(transmitted).mean, 1.0, 1e-6);
}

/// Of the endless series .04 + .96^2 .04 + ... and .96^2 + .96^2 .04^2 + ... only what counts one hundredth is left.
TEST_F(WhittedBranches, ThresholdBoundsTheError) {
    RenderSettings settings = whitted(40);
    settings.environment = "auto";
    settings.threshold = 0.01;
    expectEveryPixel(viewSlab(device_, 1.0, settings), 0.04 + 0.96 * 0.04 * 0.96, 1e-5);
    expectEveryPixel(viewSlab(device_, -1.0, settings), 0.96 * 0.96, 1e-5);
}

/// Inside a block of glass (n = 1.5) above a lamp: what the upper face reflects of it, under a black sky.
TEST_F(WhittedBranches, TotalInternalReflection) {
    for (const double degrees : {0.0, 40.0, 43.0, 60.0}) {
        const double cosIn = std::cos(degrees * kPi / 180.0), sinOut = 1.5 * std::sin(degrees * kPi / 180.0);
        const bool isTotal = sinOut >= 1.0;
        const double cosOut = isTotal ? 0.0 : std::sqrt(1.0 - sinOut * sinOut);
        const double s = (1.5 * cosIn - cosOut) / (1.5 * cosIn + cosOut),
                     p = (cosIn - 1.5 * cosOut) / (cosIn + 1.5 * cosOut);
        PhongMaterial phong;
        phong.diffuse = glm::vec3(0.0f);
        phong.mirror = phong.tint = glm::vec3(1.0f);
        phong.reflection = 0.25f;
        Material block = phongMaterial(phong);
        block.thin = false;
        Scene scene;
        addMesh(scene, box(addMaterial(scene, block), {-9, -2, -9}, {9, 0, 9}));
        addMesh(scene, floorQuad(addMaterial(scene, lamp(1.0f)), 8.9f, -1.0f));
        lookAtPoint(scene, {-0.5 * std::tan(degrees * kPi / 180.0), -0.5, 0.0}, {});
        RenderSettings settings = whitted(1);
        expectEveryPixel(renderFilm(device_, scene, settings), isTotal ? 1.0 : 0.5 * (s * s + p * p), 2e-4, "Fresnel");
        settings.reflection = "fixed";
        expectEveryPixel(renderFilm(device_, scene, settings), isTotal ? 1.0 : 0.25, 1e-6, "fixed share");
    }
}

/// Snell: through a block of 1 a ray of 45 degrees leaves .2929 + ... aside: the lamp below is a strip there.
TEST_F(WhittedBranches, RefractionBendsByTheIndex) {
    for (const double n : {1.2, 1.5, 2.4}) {
        const double aside = std::tan(std::asin(std::sqrt(0.5) / n));  // where the ray reaches the lower face
        Material solid = glass(static_cast<float>(n));
        Scene scene;
        addMesh(scene, box(addMaterial(scene, solid), {-9, -1, -9}, {9, 0, 9}));
        const auto x = static_cast<float>(aside);
        addMesh(scene, quad(addMaterial(scene, lamp(1.0f)), {x - 0.001f, -0.999f, 1}, {x + 0.001f, -0.999f, 1},
                            {x + 0.001f, -0.999f, -1}, {x - 0.001f, -0.999f, -1}));
        lookAtPoint(scene, {-1.0f, 1.0f, 0.0f}, {});
        const double cosIn = std::sqrt(0.5), cosOut = std::cos(std::atan(aside));
        const double s = (cosIn - n * cosOut) / (cosIn + n * cosOut), p = (n * cosIn - cosOut) / (n * cosIn + cosOut);
        expectEveryPixel(renderFilm(device_, scene, whitted(1)), 1.0 - 0.5 * (s * s + p * p), 1e-4);
    }
}

}  // namespace
}  // namespace raylab::support
