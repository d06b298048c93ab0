#include <cmath>
#include <complex>
#include <cstdio>

#include "engine/core/error.h"
#include "engine/render/tracer.h"
#include "engine/scene/f0_presets.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

using Direct = GpuTest;

RenderSettings directSettings(int64_t depth) {
    RenderSettings settings = smallImage(8, 2, depth);
    settings.integrator = "direct";
    return settings;
}

/// A floor of the material under a light from the direction `towards`, of irradiance 1 on a facing plane.
Scene litFloor(const Material& material, glm::dvec3 towards) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, material), 5.0f));
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = -glm::vec3(glm::normalize(towards));
    scene.lights = {sun};
    return scene;
}

/// What the origin sends towards `view`.
FilmImage seenFrom(Device& device, Scene scene, glm::dvec3 view, const RenderSettings& settings) {
    lookAtPoint(scene, glm::vec3(3.0 * glm::normalize(view)), glm::vec3(0.0f));
    if (std::abs(glm::normalize(view).y) > 0.99) scene.cameras[0].up = {0.0f, 0.0f, -1.0f};
    return renderFilm(device, std::move(scene), settings);
}

// The formulas of the second work and of the papers that it draws on, in double precision.

double schlick(double f0, double cosine) { return f0 + (1.0 - f0) * std::pow(1.0 - cosine, 5.0); }

double dielectric(double n, double cosine) {
    const double inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
    const double s = (cosine - n * inside) / (cosine + n * inside);
    const double p = (n * cosine - inside) / (n * cosine + inside);
    return 0.5 * (s * s + p * p);
}

/// Fresnel's equations with the complex index n + ik of Gulbrandsen 2014, g = 1, by complex arithmetic.
double conductor(double r, double cosine) {
    const double n = (1.0 - r) / (1.0 + r);
    const double k = std::sqrt((r * (n + 1.0) * (n + 1.0) - (n - 1.0) * (n - 1.0)) / (1.0 - r));
    const std::complex<double> index(n, k);
    const std::complex<double> inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
    const auto s = (cosine - index * inside) / (cosine + index * inside);
    const auto p = (index * cosine - inside) / (index * cosine + inside);
    return 0.5 * (std::norm(s) + std::norm(p));
}

double ggx(double alpha, double cosine) {
    const double tangent2 = 1.0 / (cosine * cosine) - 1.0;
    const double sum = alpha * alpha + tangent2;
    return alpha * alpha / (kPi * std::pow(cosine, 4.0) * sum * sum);
}

double schlickG1(double cosine, double k) { return cosine / (cosine * (1.0 - k) + k); }
double smithLambda(double cosine, double alpha) {
    const double tangent = std::tan(std::acos(cosine));
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * tangent * tangent) - 1.0);
}

double geometry(const std::string& choice, double o, double i, double roughness, double alpha) {
    const double ibl = roughness * roughness / 2.0, direct = (roughness + 1.0) * (roughness + 1.0) / 8.0;
    if (choice == "schlick-ggx-direct") return schlickG1(o, direct) * schlickG1(i, direct);
    if (choice == "schlick-ggx-ibl") return schlickG1(o, ibl) * schlickG1(i, ibl);
    const double a = smithLambda(o, alpha), b = smithLambda(i, alpha);
    return choice == "smith-correlated" ? 1.0 / (1.0 + a + b) : 1.0 / ((1.0 + a) * (1.0 + b));
}

/// Radiance of a horizontal surface under irradiance 1 on a plane that faces the light; l and v unit.
glm::dvec3 cookTorrance(const Material& m, const RenderSettings& choice, glm::dvec3 l, glm::dvec3 v) {
    const glm::dvec3 h = glm::normalize(l + v);
    const auto roughness = static_cast<double>(m.roughness);
    const double alpha = choice.alphaMapping == "linear" ? roughness : roughness * roughness;
    const double g = geometry(choice.geometry, v.y, l.y, roughness, alpha);
    const double cosine = glm::dot(h, v), n = static_cast<double>(m.ior);
    glm::dvec3 result;
    for (int c = 0; c < 3; ++c) {
        const auto colour = static_cast<double>(m.baseColor[c]);
        const bool exact = choice.fresnel == "exact";
        double f = 0.0;
        if (m.metallic == 1.0f)
            f = exact ? conductor(colour, cosine) : schlick(colour, cosine);
        else
            f = exact ? dielectric(n, cosine) : schlick(std::pow((n - 1.0) / (n + 1.0), 2.0), cosine);
        const double diffuse = m.metallic == 1.0f ? 0.0 : (1.0 - f) * colour / kPi;
        result[c] = (diffuse + ggx(alpha, h.y) * f * g / (4.0 * v.y * l.y)) * l.y;
    }
    return result;
}

Material metalOf(glm::vec3 f0, float roughness) {
    Material material{.baseColor = f0, .metallic = 1.0f, .roughness = roughness};
    return material;
}

Material rubyLike() { return presetMaterial(findF0Preset("ruby"), 0.35f, {0.7f, 0.2f, 0.1f}); }

/// Every pair of choices of F, G and alpha, at an oblique geometry out of the plane of incidence.
TEST_F(Direct, EveryChoiceEqualsItsFormula) {
    const glm::dvec3 l = glm::normalize(glm::dvec3(0.9, 0.5, 0.3)), v = glm::normalize(glm::dvec3(-0.8, 0.45, 0.2));
    const char* const geometries[] = {"schlick-ggx-direct", "schlick-ggx-ibl", "smith-correlated", "smith-separable"};
    for (const Material& material : {metalOf({0.95f, 0.64f, 0.29f}, 0.6f), rubyLike()})
        for (int i = 0; i < 8; ++i) {
            RenderSettings settings = directSettings(0);
            settings.geometry = geometries[i / 2];
            settings.alphaMapping = i % 2 == 0 ? "squared" : "linear";
            settings.fresnel = (i / 2 + i) % 2 == 0 ? "schlick" : "exact";
            const std::string what = settings.fresnel + " " + settings.geometry + " " + settings.alphaMapping;
            expectEveryPixel(seenFrom(device_, litFloor(material, l), v, settings),
                             cookTorrance(material, settings, l, v), 2e-4, what);
        }
}

/// Light and eye along the normal: D = 1 / (pi alpha^2), G = 1, F = F0, whatever is chosen.
TEST_F(Direct, NormalIncidenceHasAClosedForm) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    for (const char* fresnel : {"schlick", "exact"})
        for (const double roughness : {1.0, 0.5}) {
            RenderSettings settings = directSettings(0);
            settings.fresnel = fresnel;
            settings.geometry = roughness == 1.0 ? "smith-correlated" : "schlick-ggx-direct";
            const Material material = metalOf({0.9f, 0.6f, 0.3f}, static_cast<float>(roughness));
            const double d = 1.0 / (kPi * std::pow(roughness, 4.0));
            expectEveryPixel(seenFrom(device_, litFloor(material, up), up, settings),
                             d / 4.0 * glm::dvec3(0.9, 0.6, 0.3), 1e-4, fresnel);
        }
}

/// k_d = (1 - F)(1 - metallic): a dielectric's diffuse and specular light at normal incidence.
TEST_F(Direct, SpecularShareIsTakenFromTheDiffuse) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    Material material = presetMaterial(findF0Preset("diamond"), 1.0f, glm::vec3(0.5f));
    const double exact = (1.0 - 0.17) * 0.5 / kPi + 0.17 / (4.0 * kPi);
    expectEveryPixel(seenFrom(device_, litFloor(material, up), up, directSettings(0)), exact, 1e-4);
}

/// Water is 1.33 by any handbook, glass (high) 1.79 by the table's .08; the render of diamond above checks a third.
TEST(F0Presets, DielectricsHaveTheirIndex) {
    EXPECT_EQ(f0Presets().size(), 12u);
    EXPECT_NEAR(presetMaterial(findF0Preset("water"), 0.0f).ior, 1.33, 0.005);
    EXPECT_NEAR(presetMaterial(findF0Preset("glass (high)"), 0.0f).ior, 1.7888, 1e-4);
    EXPECT_EQ(presetMaterial(findF0Preset("gold"), 0.2f).baseColor, glm::vec3(1.0f, 0.71f, 0.29f));
    EXPECT_THROW(findF0Preset("unobtainium"), Error);
}

/// A3, through this integrator; and two lights add up.
TEST_F(Direct, PointLightsFallOffAndAdd) {
    const glm::dvec3 intensity(10.0, 20.0, 5.0);
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.6f)), 5.0f));
    Light near, far;
    near.position = {0.0f, 1.5f, 0.0f};
    near.intensity = glm::vec3(intensity);
    far.position = {2.0f, 3.0f, 0.0f};
    far.intensity = glm::vec3(intensity);
    const double d2 = 4.0 + 9.0;
    const double nearE = 1.0 / (1.5 * 1.5), farE = 3.0 / std::sqrt(d2) / d2;
    const glm::dvec3 view(1.0, 0.6, 2.0);
    for (const auto& [lights, irradiance] :
         {std::pair{std::vector{near}, nearE}, {std::vector{far}, farE}, {std::vector{near, far}, nearE + farE}}) {
        scene.lights = lights;
        const FilmImage film = seenFrom(device_, scene, view, directSettings(0));
        expectEveryPixel(film, 0.6 / kPi * irradiance * intensity, 1e-4);
        EXPECT_LT(estimateOf(film).standardError, 1e-7 * estimateOf(film).mean) << "noise";
    }
}

TEST_F(Direct, ShadowsAreHardOrNone) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    Scene scene = litFloor(lambert(0.6f), up);
    addMesh(scene, floorQuad(0, 0.5f, 1.0f));
    RenderSettings settings = directSettings(0);
    settings.shadows = "hard";
    const glm::dvec3 view(2.0, 1.0, 0.0);
    expectEveryPixel(seenFrom(device_, scene, view, settings), 0.0, 0.0, "hard");
    settings.shadows = "none";
    expectEveryPixel(seenFrom(device_, scene, view, settings), 0.6 / kPi, 1e-4, "none");
}

/// What is behind a point light throws no shadow.
TEST_F(Direct, ShadowRaysEndAtTheLight) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.6f)), 5.0f));
    addMesh(scene, floorQuad(0, 5.0f, 1.1f));
    Light light;
    light.position = {0.0f, 1.0f, 0.0f};
    scene.lights = {light};
    lookAtPoint(scene, {0.5f, 0.5f, 0.0f}, glm::vec3(0.0f));
    expectEveryPixel(renderFilm(device_, scene, directSettings(0)), 0.6 / kPi, 1e-4);
}

/// Two facing mirrors of reflectance .9 that a ray leaves for a white sky after `images` reflections, which it meets a
/// tenth apart.
Scene corridor(int images) {
    Scene scene;
    scene.environment = constantEnvironment(1.0f);
    const uint32_t mirror = addMaterial(scene, metalOf(glm::vec3(0.9f), 0.0f));
    const auto last = 0.1f * static_cast<float>(images);
    addMesh(scene, quad(mirror, {-1, 0, 1}, {last, 0, 1}, {last, 0, -1}, {-1, 0, -1}));
    addMesh(scene, quad(mirror, {-1, 1, -1}, {last, 1, -1}, {last, 1, 1}, {-1, 1, 1}));
    lookAtPoint(scene, {0.0f, 0.5f, 0.0f}, {0.05f, 0.0f, 0.0f});
    return scene;
}

/// A9: the k-th image is .9^k bright, and there are as many images as the depth says.
TEST_F(Direct, FacingMirrorsDimByTheirReflectance) {
    const std::pair<int, double> published[] = {{4, 0.6561}, {10, 0.3487}, {25, 0.0718}};
    for (const auto& [depth, brightness] : published) {
        const FilmImage film = renderFilm(device_, corridor(depth), directSettings(depth));
        std::printf("depth %d: %.6f (exact %.6f)\n", depth, estimateOf(film).mean, std::pow(0.9, depth));
        expectEveryPixel(film, std::pow(0.9, depth), 1e-4, "depth " + std::to_string(depth));
        EXPECT_NEAR(estimateOf(film).mean, brightness, 5e-5);
        expectEveryPixel(renderFilm(device_, corridor(depth), directSettings(depth - 1)), 0.0, 0.0, "one too few");
    }
}

TEST_F(Direct, MirrorRoughnessDecidesWhatMirrors) {
    Scene scene;
    scene.environment = constantEnvironment(1.0f);
    addMesh(scene, floorQuad(addMaterial(scene, metalOf(glm::vec3(0.9f), 0.1f)), 5.0f));
    RenderSettings settings = directSettings(4);
    const glm::dvec3 view(0.1, 1.0, 0.0);
    expectEveryPixel(seenFrom(device_, scene, view, settings), 0.0, 0.0, "rough");
    settings.mirrorRoughness = 0.11;
    expectEveryPixel(seenFrom(device_, scene, view, settings), 0.9, 1e-5, "mirror");
}

/// A smooth dielectric mirrors by its Fresnel reflectance (A8's figures at n = 1.5) and its body is lit by the rest.
TEST_F(Direct, DielectricMirrorsByFresnel) {
    const std::pair<double, double> published[] = {{45.0, 0.050240}, {60.0, 0.089187}, {75.0, 0.253061}};
    for (const auto& [degrees, reflectance] : published) {
        Material glaze{.baseColor = glm::vec3(0.5f), .roughness = 0.0f};
        Scene scene = litFloor(glaze, {0.0, 1.0, 0.0});
        scene.lights.clear();
        scene.environment = constantEnvironment(1.0f);
        RenderSettings settings = directSettings(1);
        settings.fresnel = "exact";
        const double angle = degrees * kPi / 180.0;
        expectEveryPixel(seenFrom(device_, scene, {std::sin(angle), std::cos(angle), 0.0}, settings), reflectance,
                         2e-4);
    }
}

/// All of the light goes the likelier way: straight through a slab, back from the inside of a face past 41.81 degrees.
TEST_F(Direct, GlassTakesTheLikelierWay) {
    for (const double degrees : {40.0, 43.0}) {
        Scene scene;
        scene.environment = environmentOf(64, 32, [](glm::dvec3 d) { return d.y > 0.0 ? 1.0 : 0.0; });
        addMesh(scene, box(addMaterial(scene, glass()), {-10, -2, -10}, {10, 0, 10}));
        const double angle = degrees * kPi / 180.0;
        lookAtPoint(scene, glm::vec3(0.5 * std::sin(angle), -0.5 * std::cos(angle), 0.0), glm::vec3(0.0f));
        const FilmImage film = renderFilm(device_, scene, directSettings(1));
        expectEveryPixel(film, degrees < 41.0 ? 2.25 : 0.0, 1e-5, std::to_string(degrees));
    }
}

TEST_F(Direct, FaintImagesAreLeftOut) {
    RenderSettings settings = directSettings(4);
    settings.threshold = 0.65;
    expectEveryPixel(renderFilm(device_, corridor(4), settings), 0.6561, 1e-4, "below");
    settings.threshold = 0.66;
    expectEveryPixel(renderFilm(device_, corridor(4), settings), 0.0, 0.0, "above");
}

TEST_F(Direct, AmbientLightIsScatteredByTheDiffuseAlbedo) {
    Scene scene = litFloor(lambert(0.6f), {0.0, 1.0, 0.0});
    scene.lights.clear();
    RenderSettings settings = directSettings(0);
    settings.ambient = 0.5;
    settings.environment = "none";
    expectEveryPixel(seenFrom(device_, scene, {1.0, 1.0, 0.0}, settings), 0.3, 1e-6);
}

TEST_F(Direct, EmissionIsSeen) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lamp(3.0f)), 1.0f));
    expectEveryPixel(seenFrom(device_, scene, {0.0, 1.0, 0.5}, directSettings(0)), 3.0, 1e-6);
}

TEST_F(Direct, SameOnEveryTracer) {
    Scene scene = quadricScene(3);
    scene.materials[0] = rubyLike();
    addMesh(scene, box(addMaterial(scene, metalOf(glm::vec3(0.8f), 0.0f)), {-2, -1.9f, -4}, {2, 1, -3}));
    Light light;
    light.position = {2.0f, 5.0f, 6.0f};
    light.intensity = glm::vec3(60.0f);
    scene.lights = {light};
    lookAt(scene, {0.0f, 3.0f, 9.0f}, glm::vec3(0.0f), 0.8f);
    RenderSettings settings = directSettings(6);
    settings.width = settings.height = 32;
    settings.trees = "merged";
    const FilmImage software = renderFilm(device_, scene, settings);
    EXPECT_GT(estimateOf(software).mean, 0.01);
    for (const std::string& tracer : tracerNames()) {
        if (!missingForTracer(tracer, device_.description()).empty()) continue;
        settings.tracer = tracer;
        const size_t different = countDifferent(software.mean, renderFilm(device_, scene, settings).mean, 1e-3f);
        std::printf("%-10s %zu of %zu values differ by more than 1e-3\n", tracer.c_str(), different,
                    software.mean.pixels.size());
        EXPECT_LE(different, software.mean.pixels.size() / 50) << tracer;
    }
}

}  // namespace
}  // namespace raylab::support
