#include "engine/measure/unneeded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

namespace raylab::support {
namespace {

using Unneeded = GpuTest;

Texture blankTexture(const std::string& name, uint32_t size) {
    Texture texture;
    texture.name = name;
    texture.width = texture.height = size;
    texture.texels.assign(size_t{size} * size, 0xffffffffu);
    return texture;
}

/// 16 pixels show one unit, over which a texture of 1024 texels lies: 64 a pixel; of 16 texels: one.
TEST_F(Unneeded, TexturesFinerThanPixelsAreNamedByHowMuch) {
    Scene scene;
    scene.textures = {blankTexture("fine", 1024), blankTexture("right", 16), blankTexture("unused", 1024)};
    Material material = lambert(0.5f);
    material.baseColorTexture = 0;
    material.normalTexture = 1;
    addMesh(scene, floorQuad(addMaterial(scene, material), 0.5f));
    Material behind = lambert(0.5f);
    behind.baseColorTexture = 2;
    addMesh(scene, floorQuad(addMaterial(scene, behind), 0.5f, 10.0f));  // above the camera, which looks down
    lookDown(scene, 3.0f);
    const std::vector<FineTexture> fine = texturesBelowPixels(scene, smallImage(16, 1, 1));
    ASSERT_EQ(fine.size(), 1u);
    EXPECT_EQ(fine[0].name, "fine");
    EXPECT_NEAR(fine[0].texelsPerPixel, 64.0, 1e-3);
    EXPECT_EQ(texturesBelowPixels(scene, smallImage(600, 1, 1)).size(), 0u);  // less than two texels a pixel
}

/// Over a floor, lights of the same place share by their intensities; what shines from below it gives nothing, and what
/// is seen by no one neither.
TEST_F(Unneeded, LightsShareByWhatTheyGive) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.5f)), 50.0f));
    for (const auto& [name, height, intensity] :
         {std::tuple{"strong", 2.0f, 3.0f}, std::tuple{"weak", 2.0f, 1.0f}, std::tuple{"below", -2.0f, 100.0f}}) {
        Light light;
        light.name = name;
        light.position = {0.0f, height, 0.0f};
        light.intensity = glm::vec3(intensity);
        scene.lights.push_back(light);
    }
    lookDown(scene, 3.0f);
    RenderSettings settings = smallImage(16, 64, 1);
    Reference reference;
    reference.image.mean = renderFilm(device_, scene, settings).mean;
    const auto shares = lightShares(device_, scene, settings, reference, [] { return false; });
    ASSERT_TRUE(shares);
    ASSERT_EQ(shares->size(), 3u);
    EXPECT_NEAR((*shares)[0].share.value, 0.75, 0.01);
    EXPECT_NEAR((*shares)[1].share.value, 0.25, 0.01);
    EXPECT_EQ((*shares)[2].name, "below");
    EXPECT_LT((*shares)[2].share.high, kNoEffect);
}

}  // namespace
}  // namespace raylab::support
