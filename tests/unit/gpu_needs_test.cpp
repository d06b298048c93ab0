#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/needs.h"
#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"
#include "tests/support/trace_choice.h"

namespace raylab::support {
namespace {

Texture checkers(bool cutOut) {
    Texture texture;
    texture.width = texture.height = 16;
    texture.srgb = true;
    for (uint32_t i = 0; i < 256; ++i) {
        const bool dark = ((i / 2 + i / 32) & 1) != 0;
        texture.texels.push_back(!dark ? 0xffe0c0a0u : cutOut ? 0x00406080u : 0xff406080u);
    }
    return texture;
}

/// Instances, textures, a mask, glass, a smooth metal, a lamp and a sun; no normal map and no environment.
Scene variousScene() {
    Scene scene;
    scene.textures = {checkers(false), checkers(true)};
    Material floor = lambert(0.9f);
    floor.baseColorTexture = 0;
    addMesh(scene, floorQuad(addMaterial(scene, floor), 4.0f, -1.0f));
    Material fence = lambert(0.7f);
    fence.baseColorTexture = 1;
    fence.alphaMode = AlphaMode::mask;
    addMesh(scene, quad(addMaterial(scene, fence), {-3, -1, -2}, {3, -1, -2}, {3, 2, -2}, {-3, 2, -2}));
    Material metal;
    metal.metallic = 1.0f;
    metal.roughness = 0.4f;
    Mesh ball = meshOf(accel_test::sphere(0.5f, 12, 24, glm::vec3(0.0f)), addMaterial(scene, metal));
    for (const glm::vec3& p : ball.positions) ball.normals.push_back(glm::normalize(p));
    const glm::mat4 left = glm::translate(glm::mat4(1.0f), {-1.2f, 0.0f, 0.0f});
    const uint32_t mesh = addMesh(scene, std::move(ball), glm::rotate(left, 0.7f, {0.3f, 1.0f, 0.2f}));
    addInstance(scene, mesh, glm::scale(glm::translate(glm::mat4(1.0f), {1.3f, 0.0f, 0.0f}), {-1.0f, 1.5f, 0.8f}));
    addMesh(scene, box(addMaterial(scene, glass()), {-0.4f, -0.9f, 0.0f}, {0.4f, 0.4f, 0.8f}));
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(6.0f)), 0.7f, 3.0f));
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = glm::normalize(glm::vec3(0.4f, -1.0f, -0.7f));
    scene.lights = {sun};
    lookAt(scene, {0.0f, 1.0f, 6.0f}, glm::vec3(0.0f), 0.7f);
    return scene;
}

using Needs = GpuTest;

/// What a kernel lacks because the scene does not need it must not show, of one tree or a tree below instances.
TEST_F(Needs, SpecialisedKernelRendersWhatTheFullOneDoes) {
    const Scene scene = variousScene();
    for (const RenderSettings& base : {smallImage(32, 8, 5), twoLevels(smallImage(32, 8, 5))}) {
        RenderSettings settings = base;
        const uint32_t mask = analyseNeeds(scene, treePlanConfig(traceConfig(settings, scene))).mask;
        ASSERT_NE(mask, shared::kNeedAll) << "nothing left to leave out";
        ASSERT_EQ((mask & shared::kNeedInstancing) != 0u, settings.flattenLimit == 0);
        const FilmImage lean = renderFilm(device_, scene, settings);
        settings.needs = "full";
        const FilmImage full = renderFilm(device_, scene, settings);
        EXPECT_LE(countDifferent(lean.mean, full.mean, 1e-4f), lean.mean.pixels.size() / 100);
        EXPECT_EQ(lean.nonFinitePixels + full.nonFinitePixels, 0u);
        const FilmImage brute = renderFilm(device_, scene, bruteForce(settings));
        EXPECT_LE(countDifferent(brute.mean, full.mean, 1e-5f), full.mean.pixels.size() / 1000);
    }
}

/// A scene that needs less and less: the merged tree and flat Lambertian surfaces alone.
TEST_F(Needs, LeanestKernelRendersWhatTheFullOneDoes) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.5f)), 3.0f));
    addMesh(scene, box(addMaterial(scene, lambert(0.8f)), {-0.5f, 0.0f, -0.5f}, {0.5f, 1.0f, 0.5f}));
    scene.environment = constantEnvironment(1.0f);
    lookAt(scene, {2.0f, 2.0f, 3.0f}, glm::vec3(0.0f), 0.8f);
    ASSERT_EQ(analyseNeeds(scene).mask, shared::kNeedEnvironment);
    RenderSettings settings = smallImage(16, 16, 5);
    const FilmImage lean = renderFilm(device_, scene, settings);
    settings.needs = "full";
    const FilmImage full = renderFilm(device_, scene, settings);
    EXPECT_LE(countDifferent(lean.mean, full.mean, 1e-4f), lean.mean.pixels.size() / 100);
}

}  // namespace
}  // namespace raylab::support
