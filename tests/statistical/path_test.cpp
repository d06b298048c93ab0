#include <cmath>
#include <cstdio>

#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

using PathTracer = GpuTest;

Material metal(float reflectance, float alpha) {
    Material material;
    material.baseColor = glm::vec3(reflectance);
    material.metallic = 1.0f;
    material.roughness = std::sqrt(alpha);
    return material;
}

/// A9, S16: two mirrors of reflectance .9 that face each other. A ray leaves the corridor after exactly `images`
/// reflections into a white sky; cut off one event earlier it is black. At this angle Schlick's term adds 4e-12.
TEST_F(PathTracer, FacingMirrors) {
    const std::pair<int, double> published[] = {{4, 0.6561}, {10, 0.3487}, {25, 0.0718}};
    for (const auto& [images, exact] : published) {
        const double slope = 0.1, half = 2.0 * slope * images;  // a reflection every 2 slope, the first at slope
        const auto x = static_cast<float>(half);
        Scene scene;
        scene.environment = constantEnvironment(1.0f);
        const uint32_t mirror = addMaterial(scene, metal(0.9f, 0.0f));
        addMesh(scene, quad(mirror, {-x, -1, -1}, {x, -1, -1}, {x, 1, -1}, {-x, 1, -1}));
        addMesh(scene, quad(mirror, {x, -1, 1}, {-x, -1, 1}, {-x, 1, 1}, {x, 1, 1}));
        lookAtPoint(scene, glm::vec3(0.0f), {static_cast<float>(slope), 0.0f, -1.0f});
        RenderSettings settings = smallImage(8, 4, images);
        settings.rouletteDepth = 1000;
        const FilmImage film = renderFilm(device_, scene, settings);
        std::printf("%d images: %.6f, exactly %.6f\n", images, estimateOf(film).mean, std::pow(0.9, images));
        expectEveryPixel(film, std::pow(0.9, images), 1e-5, std::to_string(images) + " images");
        EXPECT_NEAR(std::pow(0.9, images), exact, 5e-5);
        settings.depth = images - 1;
        expectEveryPixel(renderFilm(device_, scene, settings), 0.0, 0.0, "cut off");
        if (images > 10) continue;  // roulette would want more samples than it saves
        settings.depth = 200;
        settings.rouletteDepth = 1;
        settings.spp = 8192;
        expectExact(renderFilm(device_, scene, settings), std::pow(0.9, images), "with roulette");
    }
}

/// A disc of 2048 edges at height y that faces down.
Mesh disc(uint32_t material, float radius, float y) {
    Mesh mesh;
    mesh.material = material;
    mesh.positions = {{0.0f, y, 0.0f}};
    constexpr uint32_t kEdges = 2048;
    for (uint32_t i = 0; i < kEdges; ++i) {
        const double phi = 2.0 * kPi * i / kEdges;
        mesh.positions.emplace_back(radius * std::cos(phi), y, radius * std::sin(phi));
        mesh.triangles.emplace_back(0u, 1u + i, 1u + (i + 1) % kEdges);
    }
    return mesh;
}

/// A11: a disc of the sun's .533 degrees, the edge of a half-plane at height D = 1, and the floor: the penumbra is
/// D x .009303 wide (and 1/H wider, the lamp being at H = 1000), and across it light grows like (acos t - t sqrt(1 -
/// t^2)) / pi.
TEST_F(PathTracer, SunPenumbra) {
    const double height = 1000.0, width = 0.009303;
    const auto radius = static_cast<float>(0.5 * width * height);
    const double radiance = 1e5,
                 irradiance = kPi * radiance * std::pow(radius, 2.0) / (std::pow(radius, 2.0) + height * height);
    const double penumbra = width * height / (height - 1.0);
    for (const double t : {-1.02, -0.8, -0.4, 0.0, 0.4, 0.8, 1.02}) {
        Scene scene;
        addMesh(scene, floorQuad(addMaterial(scene, lambert(0.5f)), 5.0f));
        addMesh(scene,
                disc(addMaterial(scene, lamp(static_cast<float>(radiance))), radius, static_cast<float>(height)));
        addMesh(scene, quad(addMaterial(scene, lambert(0.0f)), {-5, 1, 5}, {0, 1, 5}, {0, 1, -5}, {-5, 1, -5}));
        const auto x = static_cast<float>(-0.5 * penumbra * t);
        lookAtPoint(scene, {x, 0.4f, 2.0f}, {x, 0.0f, 0.0f});
        const double visible =
            std::abs(t) >= 1.0 ? (t < 0.0 ? 1.0 : 0.0) : (std::acos(t) - t * std::sqrt(1.0 - t * t)) / kPi;
        const auto spp = 64 + (visible > 0.0 ? static_cast<int64_t>(900.0 * (1.0 - visible) / visible) : 0);
        const FilmImage film = renderFilm(device_, scene, smallImage(16, spp, 1));
        const Estimate estimate = estimateOf(film);
        const double unit = 0.5 * irradiance / kPi;
        std::printf("penumbra at t = %5.2f: %.5f +- %.5f, exactly %.5f\n", t, estimate.mean / unit,
                    estimate.standardError / unit, visible);
        expectExact(film, unit * visible, "t = " + std::to_string(t));
    }
}

/// S19: GGX so narrow that it is a mirror: under a sky of radiance 1 + y/2 all of them reflect the mirror's radiance.
TEST_F(PathTracer, NearlySpecularIsAMirror) {
    for (const float alpha : {1e-3f, 1e-4f, 0.0f})
        for (const double degrees : {10.0, 45.0, 80.0}) {
            const double angle = degrees * kPi / 180.0, cosine = std::cos(angle);
            Scene scene;
            scene.environment = environmentOf(256, 128, [](glm::dvec3 d) { return 1.0 + 0.5 * d.y; });
            addMesh(scene, floorQuad(addMaterial(scene, metal(0.9f, alpha)), 10.0f));
            lookAtPoint(scene, glm::dvec3(std::sin(angle), cosine, 0.0), glm::vec3(0.0f));
            const FilmImage film = renderFilm(device_, scene, smallImage(8, 64, 1));
            const double mirror = (0.9 + 0.1 * std::pow(1.0 - cosine, 5.0)) * (1.0 + 0.5 * cosine);
            std::printf("alpha %g at %2.0f degrees: %.6f, mirror %.6f\n", static_cast<double>(alpha), degrees,
                        estimateOf(film).mean, mirror);
            EXPECT_NEAR(estimateOf(film).mean, mirror, 0.01 * mirror);
            EXPECT_EQ(film.nonFinitePixels, 0u);
        }
}

struct NamedMaterial {
    std::string name;
    Material material;
    bool lossless;
};

std::vector<NamedMaterial> whiteMaterials() {
    std::vector<NamedMaterial> materials = {{"white paper", lambert(1.0f), true}};
    for (const float alpha : {0.0f, 0.01f, 0.25f, 1.0f})
        materials.push_back({"metal, alpha " + std::to_string(alpha), metal(1.0f, alpha), alpha == 0.0f});
    materials.push_back({"glass", glass(), true});
    Material sheet = glass();
    sheet.thin = true;
    materials.push_back({"sheet of glass", sheet, true});
    Material mixed = glass();
    mixed.transmission = 0.5f;
    mixed.thin = true;
    mixed.specular = 0.0f;
    materials.push_back({"half of a sheet", mixed, true});
    return materials;
}

/// A1 for each lobe: a box of a white material under a white sky is never brighter than the sky; without loss in the
/// lobe (GGX loses its multiple scattering) it is as bright.
TEST_F(PathTracer, FurnaceIsNeverAboveOne) {
    for (const auto& [name, material, lossless] : whiteMaterials())
        for (const double cosine : {1.0, 0.4, 0.05}) {
            Scene scene;
            scene.environment = constantEnvironment(1.0f);
            addMesh(scene, box(addMaterial(scene, material), {-50.0f, -1.0f, -50.0f}, {50.0f, 0.0f, 50.0f}));
            lookAtPoint(scene, glm::dvec3(std::sqrt(1.0 - cosine * cosine), cosine, 0.0), glm::vec3(0.0f));
            const FilmImage film = renderFilm(device_, scene, smallImage(8, 1024, 64));
            const Estimate estimate = estimateOf(film);
            std::printf("%-26s cosine %.2f: %.5f +- %.5f\n", name.c_str(), cosine, estimate.mean,
                        estimate.standardError);
            EXPECT_LE(estimate.mean, 1.0 + 1e-5 + 4.0 * estimate.standardError) << name << ", cosine " << cosine;
            if (lossless) expectExact(film, 1.0, name + ", cosine " + std::to_string(cosine));
        }
}

}  // namespace
}  // namespace raylab::support
