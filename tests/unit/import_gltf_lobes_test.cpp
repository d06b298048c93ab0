#include "engine/core/error.h"
#include "import_support.h"

namespace raylab::importtest {
namespace {

Gltf gltfWith(const nlohmann::json& extensions, const nlohmann::json& extras = nlohmann::json::object()) {
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
        gltfWith({{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.25}}},
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

TEST(ImportGltfLobes, TexturesAreLeftOutWithAWarning) {
    const ScratchFolder folder;
    const Gltf gltf = gltfWith({{"KHR_materials_sheen", {{"sheenColorTexture", {{"index", 0}}}}}});
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_TRUE(anyContains(scene.warnings, "textures of KHR_materials_sheen")) << joined(scene.warnings);
}

TEST(ImportGltfLobes, RefusesWhatMakesNoSense) {
    const ScratchFolder folder;
    const Gltf distance = gltfWith({{"KHR_materials_volume", {{"attenuationDistance", 0}}}});
    EXPECT_THROW(importScene(distance.write(folder)), Error);
    const Gltf priority = gltfWith(nlohmann::json::object(), {{"raylab", {{"priority", -1}}}});
    EXPECT_THROW(importScene(priority.write(folder)), Error);
}

}  // namespace
}  // namespace raylab::importtest
