#include <algorithm>
#include <cmath>

#include "tests/support/draw_bsdf.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/reference_path_tracer.h"
#include "tests/support/scene_build.h"

/// Textures of the lobes of KHR_materials_*.
namespace raylab::support {
namespace {

using LobeTexture = GpuTest;

/// One texel, of other numbers in its channels than any that a test looks for elsewhere.
int32_t addTexel(Scene& scene, glm::uvec4 rgba, bool srgb = false) {
    const uint32_t texel = rgba.x | rgba.y << 8 | rgba.z << 16 | rgba.w << 24;
    scene.textures.push_back({.name = "texel", .width = 1, .height = 1, .texels = {texel}, .srgb = srgb});
    return static_cast<int32_t>(scene.textures.size()) - 1;
}

float byte(unsigned value) { return static_cast<float>(value) / 255.0f; }

/// IEC 61966-2-1.
float decoded(unsigned value) {
    const double c = value / 255.0;
    return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}

/// A view across a floor of the material under a lamp and a grey sky.
Scene roomOf(const Material& material) {
    Scene scene = floorOf(material);
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(5.0f, true)), 1.2f, 2.4f));
    scene.environment = constantEnvironment(0.3f);
    lookAt(scene, {0.0f, 1.1f, 4.0f}, {0.0f, 0.0f, -0.4f}, 0.6f);
    return scene;
}

/// The picture of `textured` in a room whose textures are in `scene` already, against the reference of `plain`, which
/// has what factors and texels make together: 4 standard errors and 1 % of the mean.
void expectSameMean(Device& device, Scene scene, const Material& textured, const Material& plain, const char* what) {
    constexpr int kSize = 8;
    const auto reference = ReferencePathTracer(roomOf(plain)).render(kSize, 12000, 2, 20250301);
    scene.materials[0] = textured;
    const FilmImage film = renderFilm(device, scene, smallImage(kSize, 4096, 2));
    for (int c = 0; c < 3; ++c) {
        double mean = 0.0, exact = 0.0, variance = 0.0;
        for (size_t p = 0; p < reference.size(); ++p) {
            const size_t at = 3 * p + static_cast<size_t>(c);
            mean += static_cast<double>(film.mean.pixels[at]) / static_cast<double>(reference.size());
            exact += reference[p].mean[c] / static_cast<double>(reference.size());
            variance += reference[p].variance[c] +
                        static_cast<double>(film.variance.pixels[at]) / static_cast<double>(film.samples.pixels[p]);
        }
        const double error = std::sqrt(variance) / static_cast<double>(reference.size());
        std::printf("%s, channel %d: %.5f, reference %.5f +- %.5f\n", what, c, mean, exact, error);
        EXPECT_LE(std::abs(mean - exact), 4.0 * error) << what << ", channel " << c;
        EXPECT_LE(std::abs(mean - exact), 0.01 * exact) << what << ", channel " << c;
    }
    EXPECT_EQ(film.nonFinitePixels, 0u);
}

Material coatedVelvet() {
    Material m = lambert({0.5f, 0.4f, 0.3f});
    m.specular = 1.0f;
    m.roughness = 0.7f;
    m.sheenColor = {1.0f, 0.9f, 0.8f};
    m.sheenRoughness = 0.9f;
    m.clearcoat = 1.0f;
    m.clearcoatRoughness = 0.8f;
    return m;
}

TEST_F(LobeTexture, CoatAndSheenAreScaledByTheirChannels) {
    Material plain = coatedVelvet(), textured = plain;
    Scene scene = roomOf(plain);
    textured.lobeTextures.clearcoat = addTexel(scene, {150, 20, 30, 40});
    textured.lobeTextures.clearcoatRoughness = addTexel(scene, {10, 190, 30, 40});
    textured.lobeTextures.sheenColor = addTexel(scene, {230, 180, 120, 40}, true);
    textured.lobeTextures.sheenRoughness = addTexel(scene, {10, 20, 30, 170}, true);
    plain.clearcoat *= byte(150);
    plain.clearcoatRoughness *= byte(190);
    plain.sheenColor *= glm::vec3(decoded(230), decoded(180), decoded(120));
    plain.sheenRoughness *= byte(170);
    expectSameMean(device_, scene, textured, plain, "coat and sheen");
}

TEST_F(LobeTexture, ReflectionIsScaledByItsChannels) {
    Material plain = lambert({0.3f, 0.2f, 0.1f}), textured = plain;
    plain.ior = textured.ior = 2.2f;
    plain.specular = textured.specular = 0.9f;
    plain.specularColor = textured.specularColor = {1.5f, 1.0f, 0.7f};
    plain.roughness = textured.roughness = 0.5f;
    Scene scene = roomOf(plain);
    textured.lobeTextures.specular = addTexel(scene, {10, 20, 30, 200});
    textured.lobeTextures.specularColor = addTexel(scene, {250, 160, 90, 40}, true);
    plain.specular *= byte(200);
    plain.specularColor *= glm::vec3(decoded(250), decoded(160), decoded(90));
    expectSameMean(device_, scene, textured, plain, "specular");
}

/// The texture's direction is along the bitangent, which a rotation of a quarter turn says too.
TEST_F(LobeTexture, AnisotropyHasItsStrengthAndDirection) {
    Material m = lambert(1.0f);
    m.metallic = 1.0f;
    m.roughness = 0.45f;
    m.anisotropy = 0.9f;
    Scene scene = floorOf(m);
    scene.environment = environmentOf(64, 32, [](glm::dvec3 d) { return std::abs(d.x) > 0.5 ? 2.0 : 0.25; });
    lookAtPoint(scene, {0.1f, 1.0f, 0.3f}, glm::vec3(0.0f));
    const RenderSettings settings = smallImage(16, 1024, 1);
    Scene turned = scene;
    turned.materials[0].anisotropy *= byte(200);
    turned.materials[0].anisotropyRotationRadians = std::atan2(byte(255) * 2.0f - 1.0f, byte(127) * 2.0f - 1.0f) - 0.3f;
    scene.materials[0].anisotropyRotationRadians = -0.3f;
    const Estimate without = estimateOf(renderFilm(device_, scene, settings));
    scene.materials[0].lobeTextures.anisotropy = addTexel(scene, {127, 255, 200, 9});
    const Estimate expected = estimateOf(renderFilm(device_, turned, settings));
    expectExact(renderFilm(device_, scene, settings), expected.mean, "the same, said in numbers");
    EXPECT_GT(std::abs(without.mean - expected.mean), 0.05 * expected.mean) << "the texture changes nothing";
}

/// A thin sheet, clear on one half of its texture, under light from well below alone, lest the map's interpolation takes any
/// across the horizon: (1 - F) of its share comes through there, and nothing here.
TEST_F(LobeTexture, TransmissionVariesOverTheSurface) {
    Material m = lambert(0.0f);
    m.baseColor = glm::vec3(1.0f);
    m.transmission = 0.8f;
    m.specular = 0.0f;
    m.roughness = 0.0f;
    Scene scene = floorOf(m);
    scene.textures.push_back({.name = "clear", .width = 2, .height = 1, .texels = {0xff00ffffu, 0xff00ff00u}});
    scene.materials[0].lobeTextures.transmission = 0;
    for (size_t i = 0; i < scene.textures.size(); ++i) scene.textures[i].wrapU = scene.textures[i].wrapV = Wrap::clamp;
    scene.environment = environmentOf(64, 32, [](glm::dvec3 d) { return d.y < -0.3 ? 1.0 : 0.0; });
    const double sheet = 2.0 * 0.04 / 1.04;
    for (const float x : {-8.0f, 8.0f}) {
        lookAtPoint(scene, {x, 1.0f, 0.0f}, {x, 0.0f, 0.0f});
        const FilmImage film = renderFilm(device_, scene, smallImage(16, 4096, 1));
        if (x < 0.0f)
            expectExact(film, 0.8 * (1.0 - sheet), "clear");
        else
            EXPECT_EQ(estimateOf(film).mean, 0.0) << "opaque";
    }
}

double schlick(double cosTheta) { return 0.04 + 0.96 * std::pow(1.0 - cosTheta, 5); }

/// A smooth coat whose normal lies 20 degrees off the mesh's, on a black and on a white base, seen from 45 degrees on
/// the other side. The base is scaled by 1 - max(F) of both directions to the coat's normal; below the coat's horizon
/// nothing enters. What comes back is F of the coat's own cosine, and the base's integral by the midpoint rule.
TEST_F(LobeTexture, CoatHasANormalOfItsOwn) {
    constexpr double kTilt = 20.0 * kPi / 180.0;
    const unsigned red = static_cast<unsigned>(std::lround(127.5 + 127.5 * std::sin(kTilt)));
    const unsigned blue = static_cast<unsigned>(std::lround(127.5 + 127.5 * std::cos(kTilt)));
    for (const float albedo : {0.0f, 1.0f}) {
        Material m = lambert(albedo);
        m.clearcoat = 1.0f;
        Scene scene = floorOf(m);
        // Green of 127.5 has no byte: its error of half a step is a part of the normal that is meant.
        scene.materials[0].lobeTextures.clearcoatNormal = addTexel(scene, {red, 128, blue, 0});
        scene.environment = constantEnvironment(1.0f);
        // Tangent +X and normal +Y: the bitangent is -Z.
        const glm::dvec3 n =
            glm::normalize(glm::dvec3(red * 2.0 / 255.0 - 1.0, blue * 2.0 / 255.0 - 1.0, -(128 * 2.0 / 255.0 - 1.0)));
        const glm::dvec3 wo = glm::normalize(glm::dvec3(-1.0, 1.0, 0.0));
        const double fresnelO = schlick(glm::dot(wo, n));
        constexpr int kSteps = 400;
        double base = 0.0;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const double y = std::sqrt((i + 0.5) / kSteps), r = std::sqrt(1.0 - y * y);
                const double phi = 2.0 * kPi * (j + 0.5) / kSteps;
                const double c = glm::dot(glm::dvec3(r * std::cos(phi), y, r * std::sin(phi)), n);
                base += c > 0.0 ? 1.0 - std::max(fresnelO, schlick(c)) : 0.0;
            }
        lookAtPoint(scene, glm::vec3(wo), glm::vec3(0.0f));
        expectExact(renderFilm(device_, scene, smallImage(16, 2048, 1)),
                    fresnelO + static_cast<double>(albedo) * base / (double{kSteps} * kSteps),
                    albedo > 0.0f ? "white base" : "black base");
    }
}

/// Without a normal map of its own a coat is as smooth as the mesh, whatever the base's normals are.
TEST_F(LobeTexture, CoatWithoutANormalMapIsTheMeshs) {
    Material m = lambert(0.0f);
    m.clearcoat = 1.0f;
    Scene scene = floorOf(m);
    scene.materials[0].normalTexture = addTexel(scene, {171, 128, 247, 0});
    scene.environment = constantEnvironment(1.0f);
    lookAtPoint(scene, {-0.9f, 0.4358899f, 0.0f}, glm::vec3(0.0f));
    expectExact(renderFilm(device_, scene, smallImage(16, 1024, 1)), schlick(0.4358899));
}

}  // namespace
}  // namespace raylab::support
