#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

using Alpha = GpuTest;

/// White with alpha 0 in the columns 2, 3 and 4 of 8.
Texture holes() {
    Texture texture;
    texture.width = 8;
    texture.height = 8;
    texture.wrapU = texture.wrapV = Wrap::clamp;
    for (uint32_t i = 0; i < 64; ++i) texture.texels.push_back(i % 8 >= 2 && i % 8 <= 4 ? 0x00ffffffu : 0xffffffffu);
    return texture;
}

Material maskedBlack() {
    Material material = lambert(0.0f);
    material.alphaMode = AlphaMode::mask;
    material.baseColorTexture = 0;
    return material;
}

Material blendedBlack() {
    Material material = lambert(0.0f);
    material.alphaMode = AlphaMode::blend;
    material.alpha = 0.25f;
    return material;
}

/// A lamp of radiance 1 behind a unit square of `screen`, which fills the image.
Scene screenBeforeLamp(const Material& screen) {
    Scene scene;
    scene.textures = {holes()};
    addMesh(scene, floorQuad(addMaterial(scene, lamp(1.0f)), 5.0f, -1.0f));
    addMesh(scene, floorQuad(addMaterial(scene, screen), 0.5f));
    lookDown(scene, 0.5f);
    return scene;
}

/// The interpolated alpha crosses the cutoff of one half exactly between texels: columns 4 to 9 of 16 are holes.
TEST_F(Alpha, MaskShowsWhatIsBehind) {
    const FilmImage film = renderFilm(device_, screenBeforeLamp(maskedBlack()), smallImage(16, 16, 1));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_NEAR(film.mean.at(x, y)[0], x >= 4 && x < 10 ? 1.0f : 0.0f, 0.07f) << x << ", " << y;
    EXPECT_NEAR(estimateOf(film).mean, 3.0 / 8.0, 1e-3);
}

TEST_F(Alpha, BlendLetsItsShareThrough) {
    expectExact(renderFilm(device_, screenBeforeLamp(blendedBlack()), smallImage(16, 512, 1)), 0.75);
}

/// The same screens between a plane and a sun: shadow rays obey the same rule.
Scene screenBeforeSun(const Material& screen) {
    Scene scene;
    scene.textures = {holes()};
    addMesh(scene, floorQuad(addMaterial(scene, lambert(1.0f)), 5.0f));
    addMesh(scene, floorQuad(addMaterial(scene, screen), 0.5f, 1.0f));
    Light sun;
    sun.kind = LightKind::directional;
    sun.intensity = glm::vec3(static_cast<float>(kPi));
    scene.lights = {sun};
    lookDown(scene, 0.5f);
    return scene;
}

TEST_F(Alpha, MaskShadowsAsItLooks) {
    const FilmImage film = renderFilm(device_, screenBeforeSun(maskedBlack()), smallImage(16, 16, 1));
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            EXPECT_NEAR(film.mean.at(x, y)[0], x >= 4 && x < 10 ? 1.0f : 0.0f, 0.07f) << x << ", " << y;
}

TEST_F(Alpha, BlendShadowsByItsShare) {
    expectExact(renderFilm(device_, screenBeforeSun(blendedBlack()), smallImage(16, 512, 1)), 0.75);
}

}  // namespace
}  // namespace raylab::support
