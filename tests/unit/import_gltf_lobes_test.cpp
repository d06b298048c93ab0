#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/image8.h"
#include "import_support.h"

namespace raylab::importtest {
namespace {

Gltf gltfWithLobes(const nlohmann::json& extensions, const nlohmann::json& extras = nlohmann::json::object()) {
    Gltf gltf;
    nlohmann::json primitive = gltf.trianglePrimitive();
    primitive["material"] = 0;
    gltf.mesh(primitive);
    gltf.json["materials"] = {{{"name", "m"}, {"extensions", extensions}, {"extras", extras}}};
    return gltf;
}

TEST(ImportGltfLobes, FactorsOfAllExtensions) {
    const ScratchFolder folder;
    const Gltf gltf =
        gltfWithLobes({{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.25}}},
                  {"KHR_materials_sheen", {{"sheenColorFactor", {0.5, 0.25, 0.125}}, {"sheenRoughnessFactor", 0.375}}},
                  {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", -1.5}}},
                  {"KHR_materials_specular", {{"specularColorFactor", {1, 2, 0.5}}}},
                  {"KHR_materials_volume",
                   {{"thicknessFactor", 1}, {"attenuationColor", {1, 0.5, 0.25}}, {"attenuationDistance", 3}}}},
                 {{"raylab", {{"priority", 7}}}});
    const Scene scene = importScene(gltf.write(folder));
    const Material& m = scene.materials.at(0);
    EXPECT_EQ(m.clearcoat, 0.75f);
    EXPECT_EQ(m.clearcoatRoughness, 0.25f);
    EXPECT_EQ(m.sheenColor, glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(m.sheenRoughness, 0.375f);
    EXPECT_EQ(m.anisotropy, 0.5f);
    EXPECT_EQ(m.anisotropyRotationRadians, -1.5f);
    EXPECT_EQ(m.specularColor, glm::vec3(1.0f, 2.0f, 0.5f));
    EXPECT_EQ(m.attenuationColor, glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_EQ(m.attenuationDistance, 3.0f);
    EXPECT_EQ(m.priority, 7u);
    EXPECT_FALSE(anyContains(scene.warnings, "not read")) << joined(scene.warnings);
}

/// Each texture is a request of its own image; the names of the images say which is which.
TEST(ImportGltfLobes, TexturesOfAllExtensions) {
    const ScratchFolder folder;
    const auto at = [](int index) { return nlohmann::json{{"index", index}}; };
    Gltf gltf = gltfWithLobes(
        {{"KHR_materials_clearcoat",
          {{"clearcoatTexture", at(0)},
           {"clearcoatRoughnessTexture", at(1)},
           {"clearcoatNormalTexture", {{"index", 2}, {"scale", 0.5}}}}},
         {"KHR_materials_sheen", {{"sheenColorTexture", at(3)}, {"sheenRoughnessTexture", at(4)}}},
         {"KHR_materials_anisotropy", {{"anisotropyTexture", at(5)}}},
         {"KHR_materials_specular", {{"specularTexture", at(6)}, {"specularColorTexture", at(7)}}},
         {"KHR_materials_transmission", {{"transmissionTexture", at(8)}}},
         {"KHR_materials_volume", {{"thicknessFactor", 0.25}, {"thicknessTexture", at(9)}}}});
    for (int i = 0; i < 10; ++i) {
        const std::string name = "image " + std::to_string(i);
        const uint32_t texel = 0xff000000u + static_cast<uint32_t>(i);
        writeFileAtomically(folder.path() / ("x" + std::to_string(i) + ".png"), encodePng8(std::span(&texel, 1), 1, 1));
        gltf.json["images"].push_back({{"name", name}, {"uri", "x" + std::to_string(i) + ".png"}});
        gltf.json["textures"].push_back({{"source", i}});
    }
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_FALSE(anyContains(scene.warnings, "not read")) << joined(scene.warnings);
    const LobeTextures& t = scene.materials.at(0).lobeTextures;
    const auto expectImage = [&](int32_t texture, int image, bool srgb) {
        ASSERT_NE(texture, kNoTexture) << image;
        const Texture& found = scene.textures[static_cast<size_t>(texture)];
        EXPECT_EQ(found.name, "image " + std::to_string(image));
        EXPECT_EQ(found.srgb, srgb) << image;
    };
    expectImage(t.clearcoat, 0, false);
    expectImage(t.clearcoatRoughness, 1, false);
    expectImage(t.clearcoatNormal, 2, false);
    EXPECT_EQ(t.clearcoatNormalScale, 0.5f);
    expectImage(t.sheenColor, 3, true);
    expectImage(t.anisotropy, 5, false);
    expectImage(t.specularColor, 7, true);
    expectImage(t.transmission, 8, false);
    expectImage(t.thickness, 9, false);
    EXPECT_EQ(scene.textures[static_cast<size_t>(t.sheenRoughness)].name, "image 4");
    EXPECT_EQ(scene.textures[static_cast<size_t>(t.specular)].name, "image 6");
    EXPECT_EQ(scene.materials[0].thickness, 0.25f);
}

TEST(ImportGltfLobes, RefusesWhatMakesNoSense) {
    const ScratchFolder folder;
    const Gltf distance = gltfWithLobes({{"KHR_materials_volume", {{"attenuationDistance", 0}}}});
    EXPECT_THROW(importScene(distance.write(folder)), Error);
    const Gltf priority = gltfWithLobes(nlohmann::json::object(), {{"raylab", {{"priority", -1}}}});
    EXPECT_THROW(importScene(priority.write(folder)), Error);
}

}  // namespace
}  // namespace raylab::importtest
