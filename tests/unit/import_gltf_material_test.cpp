#include "engine/image/image_io.h"
#include "import_support.h"

namespace raylab::importtest {
namespace {

/// A triangle with one material.
Gltf gltfWith(const nlohmann::json& material) {
    Gltf gltf;
    nlohmann::json primitive = gltf.trianglePrimitive();
    primitive["material"] = 0;
    gltf.mesh(primitive);
    gltf.json["materials"] = nlohmann::json::array({material});
    return gltf;
}

void addTexture(Gltf& gltf, const std::string& uri, const nlohmann::json& sampler = nlohmann::json::object()) {
    gltf.json["images"].push_back({{"uri", uri}});
    gltf.json["samplers"].push_back(sampler);
    gltf.json["textures"].push_back(
        {{"source", gltf.json["images"].size() - 1}, {"sampler", gltf.json["samplers"].size() - 1}});
}

/// Two texels: a red one and a blue one.
void writeRedBlue(const fs::path& path) {
    Bitmap bitmap(2, 1, 3);
    bitmap.pixels = {1, 0, 0, 0, 0, 1};
    writePng(path, bitmap);
}

TEST(ImportGltfMaterial, FactorsAndExtensions) {
    const ScratchFolder folder;
    const Gltf gltf =
        gltfWith({{"name", "all"},
                  {"pbrMetallicRoughness",
                   {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}}, {"metallicFactor", 0.6}, {"roughnessFactor", 0.7}}},
                  {"emissiveFactor", {1, 0.5, 0.25}},
                  {"alphaMode", "MASK"},
                  {"alphaCutoff", 0.3},
                  {"doubleSided", true},
                  {"extensions",
                   {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
                    {"KHR_materials_transmission", {{"transmissionFactor", 0.9}}},
                    {"KHR_materials_ior", {{"ior", 1.33}}},
                    {"KHR_materials_volume", {{"thicknessFactor", 1}}},
                    {"KHR_materials_specular", {{"specularFactor", 0.25}}},
                    {"KHR_materials_iridescence", nlohmann::json::object()}}}});
    const Scene scene = importScene(gltf.write(folder));
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.name, "all");
    EXPECT_EQ(material.baseColor, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.alpha, 0.4f);
    EXPECT_EQ(material.metallic, 0.6f);
    EXPECT_EQ(material.roughness, 0.7f);
    EXPECT_EQ(material.emission, glm::vec3(8, 4, 2));
    EXPECT_EQ(material.alphaMode, AlphaMode::mask);
    EXPECT_EQ(material.alphaCutoff, 0.3f);
    EXPECT_TRUE(material.doubleSided);
    EXPECT_EQ(material.transmission, 0.9f);
    EXPECT_EQ(material.ior, 1.33f);
    EXPECT_FALSE(material.thin);
    EXPECT_EQ(material.specular, 0.25f);
    EXPECT_TRUE(anyContains(scene.warnings, "KHR_materials_iridescence")) << joined(scene.warnings);
}

/// Defaults of the specification, section 5.19 and 5.22.
TEST(ImportGltfMaterial, Defaults) {
    const ScratchFolder folder;
    const Scene scene = importScene(gltfWith(nlohmann::json::object()).write(folder));
    const Material& material = scene.materials.at(0);
    EXPECT_EQ(material.baseColor, glm::vec3(1));
    EXPECT_EQ(material.metallic, 1.0f);
    EXPECT_EQ(material.roughness, 1.0f);
    EXPECT_EQ(material.emission, glm::vec3(0));
    EXPECT_EQ(material.ior, 1.5f);
    EXPECT_EQ(material.specular, 1.0f);
    EXPECT_TRUE(material.thin);
    EXPECT_EQ(material.alphaMode, AlphaMode::opaque);
}

TEST(ImportGltfMaterial, UnlitEmitsItsBaseColor) {
    const ScratchFolder folder;
    const Gltf gltf = gltfWith({{"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.2, 0.3, 1}}}},
                                {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}});
    const Material material = importScene(gltf.write(folder)).materials.at(0);
    EXPECT_EQ(material.emission, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(material.baseColor, glm::vec3(0));
    EXPECT_EQ(material.specular, 0.0f);
}

TEST(ImportGltfMaterial, OneImageInTwoRolesBecomesTwoTextures) {
    const ScratchFolder folder;
    Gltf gltf = gltfWith(
        {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 0}}}}},
         {"emissiveTexture", {{"index", 0}}},
         {"emissiveFactor", {1, 1, 1}}});
    addTexture(gltf, "red%20blue.png", {{"wrapS", 33071}, {"wrapT", 33648}});
    writeRedBlue(folder.path() / "red blue.png");
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_TRUE(scene.warnings.empty()) << joined(scene.warnings);
    ASSERT_EQ(scene.textures.size(), 2u) << "one sRGB, one linear";
    const Material& material = scene.materials[0];
    EXPECT_EQ(material.baseColorTexture, material.emissionTexture);
    const Texture& color = scene.textures.at(static_cast<size_t>(material.baseColorTexture));
    EXPECT_TRUE(color.srgb);
    EXPECT_FALSE(scene.textures.at(static_cast<size_t>(material.metallicRoughnessTexture)).srgb);
    EXPECT_EQ(color.wrapU, Wrap::clamp);
    EXPECT_EQ(color.wrapV, Wrap::mirror);
    EXPECT_EQ(color.width, 2u);
    EXPECT_EQ(color.height, 1u);
    EXPECT_EQ(color.texels, (std::vector<uint32_t>{0xFF0000FFu, 0xFFFF0000u}));
}

TEST(ImportGltfMaterial, ImageInABufferView) {
    const ScratchFolder folder;
    writeRedBlue(folder.path() / "image.png");
    std::ifstream stream(folder.path() / "image.png", std::ios::binary);
    const std::vector<char> png{std::istreambuf_iterator<char>(stream), {}};
    Gltf gltf = gltfWith({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    gltf.json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", gltf.buffer.size()}, {"byteLength", png.size()}});
    gltf.buffer.append(png.begin(), png.end());
    gltf.json["images"] = {{{"bufferView", gltf.json["bufferViews"].size() - 1}, {"mimeType", "image/png"}}};
    gltf.json["textures"] = {{{"source", 0}}};
    const Scene scene = importScene(folder.write("scene.glb", gltf.glb()));
    ASSERT_EQ(scene.textures.size(), 1u) << joined(scene.warnings);
    EXPECT_EQ(scene.textures[0].texels, (std::vector<uint32_t>{0xFF0000FFu, 0xFFFF0000u}));
}

TEST(ImportGltfMaterial, MissingAndDamagedTexturesLeaveTheFactor) {
    const ScratchFolder folder;
    Gltf gltf = gltfWith({{"name", "wood"},
                          {"pbrMetallicRoughness",
                           {{"baseColorFactor", {0.1, 0.2, 0.3, 1}},
                            {"baseColorTexture", {{"index", 0}}},
                            {"metallicRoughnessTexture", {{"index", 1}}}}}});
    addTexture(gltf, "gone.png");
    addTexture(gltf, "damaged.png");
    folder.write("damaged.png", "\x89PNG\r\n\x1a\n and no more");
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_EQ(scene.materials[0].baseColorTexture, kNoTexture);
    EXPECT_EQ(scene.materials[0].metallicRoughnessTexture, kNoTexture);
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec3(0.1f, 0.2f, 0.3f));
    ASSERT_EQ(scene.warnings.size(), 2u) << joined(scene.warnings);
    EXPECT_TRUE(anyContains(scene.warnings, "gone.png")) << joined(scene.warnings);
    EXPECT_TRUE(anyContains(scene.warnings, "damaged.png")) << joined(scene.warnings);
    EXPECT_TRUE(anyContains(scene.warnings, "\"wood\""));
}

/// KHR_texture_transform's own example: offset (0, 1), rotation 90 degrees, scale (0.5, 0.5) turns (u, v) into (v/2, 1
/// - u/2).
TEST(ImportGltfMaterial, TextureTransformIsBaked) {
    const ScratchFolder folder;
    const nlohmann::json transform = {
        {"KHR_texture_transform", {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}}}};
    Gltf gltf = gltfWith({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"extensions", transform}}}}}});
    addTexture(gltf, "image.png");
    writeRedBlue(folder.path() / "image.png");
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_TRUE(scene.warnings.empty()) << joined(scene.warnings);
    const std::vector<glm::vec2> expected = {{0, 1}, {0, 0.5}, {0.5, 1}};  // of (0,0), (1,0), (0,1)
    for (size_t i = 0; i < 3; ++i) EXPECT_LT(glm::length(scene.meshes[0].uvs[i] - expected[i]), 1e-6f) << i;
}

TEST(ImportGltfMaterial, TexturesThatDisagreeAboutTransformsWarn) {
    const ScratchFolder folder;
    const nlohmann::json transform = {{"KHR_texture_transform", {{"scale", {2, 2}}}}};
    Gltf gltf = gltfWith({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"extensions", transform}}}}},
                          {"emissiveTexture", {{"index", 0}}}});
    addTexture(gltf, "image.png");
    writeRedBlue(folder.path() / "image.png");
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_TRUE(anyContains(scene.warnings, "different texture coordinates")) << joined(scene.warnings);
    EXPECT_EQ(scene.meshes[0].uvs[1], glm::vec2(2, 0)) << "those of the first";
}

TEST(ImportGltfMaterial, SecondTextureCoordinateSet) {
    const ScratchFolder folder;
    Gltf gltf = gltfWith({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}});
    gltf.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] =
        gltf.accessor<float>({0.5, 0.5, 0.25, 0.75, 0, 0}, 5126, "VEC2", 3);
    addTexture(gltf, "image.png");
    writeRedBlue(folder.path() / "image.png");
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_EQ(scene.meshes[0].uvs[1], glm::vec2(0.25f, 0.75f));
}

TEST(ImportGltfMaterial, NormalMapGetsTangents) {
    const ScratchFolder folder;
    Gltf gltf = gltfWith({{"normalTexture", {{"index", 0}, {"scale", 0.5}}}});
    addTexture(gltf, "image.png");
    writeRedBlue(folder.path() / "image.png");
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_EQ(scene.materials[0].normalScale, 0.5f);
    EXPECT_FALSE(scene.textures.at(static_cast<size_t>(scene.materials[0].normalTexture)).srgb);
    ASSERT_EQ(scene.meshes[0].tangents.size(), 3u);
    // u grows along +X, and v, which grows downwards, along +Y: the image is mirrored.
    for (const glm::vec4& tangent : scene.meshes[0].tangents) EXPECT_EQ(tangent, glm::vec4(1, 0, 0, -1));
}

TEST(ImportGltfExtras, SkyAndEnvironment) {
    const ScratchFolder folder;
    Gltf gltf = gltfWith(nlohmann::json::object());
    Bitmap bitmap(2, 1, 3);
    bitmap.pixels = {1, 2, 4, 0.5, 0, 8};  // exact in RGBE
    writeHdr(folder.path() / "sky.hdr", bitmap);
    gltf.json["scenes"][0]["extras"] = "a string of another program";
    gltf.json["extras"]["raylab"] = {{"environment", "sky.hdr"},
                                     {"environmentScale", 3},
                                     {"sun", {{"elevation", 30}, {"azimuth", 90}, {"turbidity", 4}, {"scale", 2}}}};
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_TRUE(scene.warnings.empty()) << joined(scene.warnings);
    ASSERT_TRUE(scene.environment);
    const Bitmap& radiance = scene.environment->radiance;
    EXPECT_EQ(radiance.channels, 3);
    for (size_t i = 0; i < 6; ++i) EXPECT_NEAR(radiance.pixels[i], 3 * bitmap.pixels[i], 3 * 8.0f / 256) << i;
    ASSERT_TRUE(scene.sky);
    EXPECT_NEAR(scene.sky->sunElevationRadians, 0.5235988f, 1e-6f);
    EXPECT_NEAR(scene.sky->sunAzimuthRadians, 1.5707963f, 1e-6f);
    EXPECT_EQ(scene.sky->turbidity, 4.0f);
    EXPECT_EQ(scene.sky->scale, 2.0f);
}

TEST(ImportGltfExtras, MissingEnvironmentWarnsAndBadValuesThrow) {
    const ScratchFolder folder;
    Gltf gltf = gltfWith(nlohmann::json::object());
    gltf.json["extras"]["raylab"]["environment"] = "gone.hdr";
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_FALSE(scene.environment);
    EXPECT_FALSE(scene.sky);
    EXPECT_TRUE(anyContains(scene.warnings, "gone.hdr"));
    gltf.json["extras"]["raylab"]["sun"]["elevation"] = 400;
    EXPECT_NE(errorOf(gltf.write(folder)).find("extras.raylab.sun"), std::string::npos);
}

}  // namespace
}  // namespace raylab::importtest
