#include <cmath>

#include "engine/render/tracer.h"
#include "engine/scene/import.h"
#include "tests/support/estimate.h"
#include "tests/support/paths.h"
#include "whitted_support.h"

namespace raylab::support {
namespace {

using Whitted = GpuTest;

constexpr glm::dvec3 kDiffuse(0.6, 0.3, 0.1);
constexpr glm::dvec3 kIntensity(10.0, 20.0, 5.0);

PhongMaterial plaster() {
    PhongMaterial phong;
    phong.diffuse = glm::vec3(kDiffuse);
    return phong;
}

/// A sheet that lets light through without bending it.
Material pane(glm::vec3 tint, float reflection) {
    PhongMaterial phong;
    phong.diffuse = glm::vec3(0.0f);
    phong.mirror = glm::vec3(1.0f);
    phong.tint = tint;
    phong.reflection = reflection;
    return phongMaterial(phong);
}

/// A plane at y = 0.
Scene planeScene(const Material& material) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, material), 4.0f));
    return scene;
}

Light pointLight(glm::vec3 position) {
    Light light;
    light.position = position;
    light.intensity = glm::vec3(kIntensity);
    return light;
}

/// One point of the plane, seen from the side so that nothing is in the way.
FilmImage viewPoint(Device& device, Scene scene, glm::vec3 point, const RenderSettings& settings) {
    lookAtPoint(scene, point + glm::vec3(3.0f, 0.4f, 1.0f), point);
    return renderFilm(device, scene, settings);
}

/// The values of the materials' own form, and of a metallic-roughness material that scatters only.
TEST_F(Whitted, AmbientLightAlone) {
    RenderSettings settings = whitted();
    settings.ambient = 0.5;
    for (const Material& material : {phongMaterial(plaster()), lambert(glm::vec3(kDiffuse))})
        expectEveryPixel(viewPoint(device_, planeScene(material), {}, settings), 0.5 * kDiffuse, 1e-6);
}

/// A3 with each attenuation: the radiance is k_d / pi times the irradiance.
TEST_F(Whitted, PointLightIsAttenuatedAsChosen) {
    const std::pair<const char*, double> attenuations[] = {{"none", 0.0}, {"linear", 1.0}, {"quadratic", 2.0}};
    for (const auto& [name, power] : attenuations) {
        RenderSettings settings = whitted();
        settings.attenuation = name;
        for (const double height : {1.5, 3.0}) {
            Scene scene = planeScene(phongMaterial(plaster()));
            scene.lights = {pointLight({0.0f, height, 0.0f})};
            for (const double aside : {0.0, 2.0}) {
                const double d = std::hypot(aside, height);
                const glm::dvec3 irradiance = kIntensity * (height / d) / std::pow(d, power);
                expectEveryPixel(viewPoint(device_, scene, {0.0f, 0.0f, -aside}, settings), kDiffuse / kPi * irradiance,
                                 1e-4, name);
            }
        }
    }
}

/// Attenuation is a matter of the distance alone: the cone of a spot stays, a directional light knows none.
TEST_F(Whitted, SpotAndDirectionalLight) {
    RenderSettings settings = whitted();
    settings.attenuation = "linear";
    Scene scene = planeScene(phongMaterial(plaster()));
    Light spot = pointLight({0.0f, 2.0f, 0.0f});
    spot.kind = LightKind::spot;
    spot.innerConeRadians = 0.3f;
    spot.outerConeRadians = 0.6f;
    scene.lights = {spot};
    const double cosine = std::cos(0.45), ramp = (cosine - std::cos(0.6)) / (std::cos(0.3) - std::cos(0.6));
    const glm::dvec3 spotIrradiance = kIntensity * ramp * ramp * cosine / (2.0 / cosine);
    expectEveryPixel(viewPoint(device_, scene, {2.0 * std::tan(0.45), 0.0, 0.0}, settings),
                     kDiffuse / kPi * spotIrradiance, 2e-4, "spot");
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = {0.8f, -0.6f, 0.0f};
    sun.intensity = glm::vec3(3.0f);
    scene.lights = {sun};
    expectEveryPixel(viewPoint(device_, scene, {}, settings), kDiffuse / kPi * 3.0 * 0.6, 1e-5, "directional");
}

/// The light comes from 45 degrees on one side and is seen from 60 on the other: 15 degrees beside the mirror
/// direction, and the half vector is 7.5 degrees off the normal.
TEST_F(Whitted, HighlightsOfPhongAndBlinn) {
    const glm::dvec3 specular(0.5, 0.25, 1.0);
    const std::pair<const char*, double> models[] = {{"phong", 15.0}, {"blinn-phong", 7.5}};
    for (const double exponent : {5.0, 80.0}) {
        PhongMaterial phong = plaster();
        phong.specular = glm::vec3(specular);
        phong.exponent = static_cast<float>(exponent);
        Scene scene = planeScene(phongMaterial(phong));
        Light sun;
        sun.kind = LightKind::directional;
        sun.direction = glm::vec3(std::sqrt(0.5f), -std::sqrt(0.5f), 0.0f);
        sun.intensity = glm::vec3(3.0f);
        scene.lights = {sun};
        lookAtPoint(scene, {2.0 * std::sin(kPi / 3.0), 2.0 * std::cos(kPi / 3.0), 0.0}, {});
        for (const auto& [name, degrees] : models) {
            RenderSettings settings = whitted();
            settings.highlight = name;
            const double lobe = std::pow(std::cos(degrees * kPi / 180.0), exponent);
            expectEveryPixel(renderFilm(device_, scene, settings),
                             3.0 / kPi * (kDiffuse * std::sqrt(0.5) + specular * lobe), 1e-4, name);
        }
    }
}

TEST_F(Whitted, LightsAddUp) {
    const Light one = pointLight({0.0f, 2.0f, 0.0f}), two = pointLight({-1.0f, 1.0f, 0.0f});
    Scene scene = planeScene(phongMaterial(plaster()));
    scene.lights = {one, two};
    expectEveryPixel(viewPoint(device_, scene, {}, whitted()),
                     kDiffuse / kPi * kIntensity * (1.0 / 4.0 + 1.0 / (2.0 * std::sqrt(2.0))), 2e-5);
}

/// A light above the panes, the plane below them.
Scene shadedScene(const std::vector<Material>& panes) {
    Scene scene = planeScene(phongMaterial(plaster()));
    scene.lights = {pointLight({0.0f, 4.0f, 0.0f})};
    for (size_t i = 0; i < panes.size(); ++i)
        addMesh(scene, floorQuad(addMaterial(scene, panes[i]), 2.0f, 1.0f + 0.05f * static_cast<float>(i)));
    return scene;
}

constexpr glm::dvec3 kUnshaded = kDiffuse / kPi * kIntensity / 16.0;

void expectShadow(Device& device, const std::vector<Material>& panes, const RenderSettings& settings, glm::dvec3 passed,
                  const std::string& what) {
    expectEveryPixel(viewPoint(device, shadedScene(panes), {}, settings), kUnshaded * passed, 1e-5,
                     settings.shadows + ", " + what);
}

TEST_F(Whitted, ShadowsOfEachKind) {
    const glm::dvec3 red(0.9, 0.3, 0.2), blue(0.1, 0.5, 1.0);
    const Material one = pane(red, 0.25f), two = pane(blue, 0.0f);
    RenderSettings settings = whitted();
    settings.shadows = "none";
    expectShadow(device_, {lambert(0.5f)}, settings, glm::dvec3(1.0), "an opaque one");
    settings.shadows = "hard";
    expectShadow(device_, {one}, settings, glm::dvec3(0.0), "one pane");
    settings.shadows = "glass";
    const double sheet = 0.923077;  // A8: both faces of a sheet, n = 1.5
    expectShadow(device_, {one}, settings, red * sheet, "one pane");
    expectShadow(device_, {one, two}, settings, red * blue * sheet * sheet, "two panes");
    expectShadow(device_, {one, two, lambert(0.5f)}, settings, glm::dvec3(0.0), "two panes below an opaque one");
    settings.reflection = "fixed";
    expectShadow(device_, {two}, settings, blue, "one pane that reflects nothing");
    expectShadow(device_, {one, two}, settings, red * blue * 0.75, "two panes of fixed shares");
}

/// A solid has two faces, and each takes its part; a light in front of an opaque surface does not see it.
TEST_F(Whitted, ShadowOfSolidGlassAndOfWhatIsBehindTheLight) {
    Scene scene = shadedScene({});
    Material solid = pane({0.9f, 0.8f, 0.7f}, 0.0f);
    solid.thin = false;
    addMesh(scene, box(addMaterial(scene, solid), {-2.0f, 1.0f, -2.0f}, {2.0f, 2.0f, 2.0f}));
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.5f)), 2.0f, 5.0f));
    expectEveryPixel(viewPoint(device_, scene, {}, whitted()), kUnshaded * glm::dvec3(0.81, 0.64, 0.49) * (0.96 * 0.96),
                     1e-5);
}

TEST_F(Whitted, ShadowRaysPassABoundedNumberOfPanes) {
    RenderSettings settings = whitted();
    settings.reflection = "fixed";
    const Material clear = pane(glm::vec3(1.0f), 0.0f);
    expectShadow(device_, std::vector<Material>(32, clear), settings, glm::dvec3(1.0), "32 panes");
    expectShadow(device_, std::vector<Material>(33, clear), settings, glm::dvec3(0.0), "33 panes");
}

TEST_F(Whitted, LampsAndTheSkyAreSeen) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lamp(3.0f)), 1.0f));
    scene.environment = constantEnvironment(0.25f);
    RenderSettings settings = whitted();
    settings.environment = "auto";
    expectEveryPixel(viewPoint(device_, scene, {}, settings), 3.0, 1e-6);
    expectEveryPixel(viewPoint(device_, scene, {5.0f, 0.0f, 0.0f}, settings), 0.25, 1e-6);
}

/// Four times over the plane: the colours of one repetition come again in the next, halves of them red and green.
TEST_F(Whitted, TexturesRepeat) {
    Texture halves;
    halves.width = halves.height = 64;
    for (uint32_t i = 0; i < 64 * 64; ++i) halves.texels.push_back(i % 64 < 32 ? 0xff0000ffu : 0xff00ff00u);
    PhongMaterial phong;
    phong.diffuse = glm::vec3(0.5f);
    Material material = phongMaterial(phong);
    material.baseColorTexture = 0;
    Scene scene = planeScene(material);
    scene.textures = {halves};
    for (glm::vec2& uv : scene.meshes[0].uvs) uv *= 4.0f;
    RenderSettings settings = whitted();
    settings.ambient = 1.0;
    for (const float x : {-3.5f, -1.5f, 0.5f, 2.5f}) {
        expectEveryPixel(viewPoint(device_, scene, {x, 0.0f, 0.3f}, settings), glm::dvec3(0.5, 0.0, 0.0), 1e-5);
        expectEveryPixel(viewPoint(device_, scene, {x + 1.0f, 0.0f, 0.3f}, settings), glm::dvec3(0.0, 0.5, 0.0), 1e-5);
    }
}

/// Quadrics and triangles of glass, mirror and plaster under a sky and two lights of our own.
Scene quadricsAsset() {
    Scene scene = importScene(binaryFolder() / "assets/quadrics.glb");
    scene.lights = {pointLight(scene.cameras.at(0).position + glm::vec3(-0.5f, 1.0f, 0.0f)),
                    pointLight(scene.cameras.at(0).position + glm::vec3(1.5f, 1.5f, -1.0f))};
    return scene;
}

RenderSettings pictureSettings(int64_t size) {
    RenderSettings settings = smallImage(size, 1, 6);
    settings.integrator = "whitted";
    settings.ambient = 0.2;
    settings.antialias = "1";
    settings.trees = "merged";
    return settings;
}

/// The middles of the pixels of an image of twice the size are the four places of the grid.
TEST_F(Whitted, FourRaysAPixelAreTheirMean) {
    Scene scene = quadricsAsset();
    for (Material& material : scene.materials)  // the level of a texture is another in an image of twice the size
        material.baseColorTexture = material.metallicRoughnessTexture = material.normalTexture = kNoTexture;
    RenderSettings grid = pictureSettings(32);
    grid.antialias = "4";
    grid.spp = 4;
    const Bitmap picture = renderFilm(device_, scene, grid).mean,
                 fine = renderFilm(device_, scene, pictureSettings(64)).mean;
    Bitmap mean(32, 32, 3);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) mean.at(x / 2, y / 2)[c] += 0.25f * fine.at(x, y)[c];
    EXPECT_LE(countDifferent(picture, mean, 1e-3f), mean.pixels.size() / 50);
}

TEST_F(Whitted, NothingIsRandom) {
    RenderSettings settings = pictureSettings(32);
    settings.spp = 3;
    const FilmImage first = renderFilm(device_, quadricsAsset(), settings);
    for (const float variance : first.variance.pixels) ASSERT_LE(variance, 1e-12f) << "more than rounding";
    settings.seed += 1;
    EXPECT_EQ(renderFilm(device_, quadricsAsset(), settings).mean.pixels, first.mean.pixels);
}

TEST_F(Whitted, SamePictureOnEveryTracer) {
    const Scene scene = quadricsAsset();
    RenderSettings settings = pictureSettings(32);
    const Bitmap software = renderFilm(device_, scene, settings).mean;
    for (const std::string& tracer : tracerNames()) {
        if (!missingForTracer(tracer, device_.description()).empty()) continue;
        settings.tracer = tracer;
        const size_t different = countDifferent(renderFilm(device_, scene, settings).mean, software, 1e-3f);
        EXPECT_LE(different, software.pixels.size() / 50) << tracer;
    }
}

}  // namespace
}  // namespace raylab::support
