#include "engine/scene/save_gltf.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <random>

#include "save_support.h"
#include "tests/support/paths.h"

namespace raylab::importtest {
namespace {

constexpr uint32_t kSeed = 20240611;

/// Numbers with all bits of a float in use.
class Dice {
public:
    float operator()(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    glm::vec3 vec(float low, float high) {
        return glm::vec3((*this)(low, high), (*this)(low, high), (*this)(low, high));
    }
    glm::vec3 unit() { return glm::normalize(vec(-1.0f, 1.0f) + glm::vec3(0.0f, 0.0f, 2.0f)); }
    glm::mat4 affine() {
        glm::mat4 m(glm::vec4(vec(-1, 1), 0), glm::vec4(vec(-1, 1), 0), glm::vec4(vec(-1, 1), 0),
                    glm::vec4(vec(-50, 50), 1));
        for (int i = 0; i < 3; ++i) m[i][i] += 4.0f;
        return m;
    }
    uint32_t bits() { return static_cast<uint32_t>(engine_()); }

private:
    std::mt19937 engine_{kSeed};
};

Texture makeTexture(Dice& dice, const std::string& name, bool srgb, bool opaque, Wrap u, Wrap v) {
    Texture texture{.name = name, .width = 5, .height = 3, .texels = {}, .srgb = srgb, .wrapU = u, .wrapV = v};
    for (int i = 0; i < 15; ++i) texture.texels.push_back(dice.bits() | (opaque ? 0xFF000000u : 0u));
    return texture;
}

Mesh makeMesh(Dice& dice, const std::string& name, uint32_t material) {
    Mesh mesh{.name = name, .material = material};
    for (uint32_t i = 0; i < 60; ++i) {
        mesh.positions.push_back(dice.vec(-1, 1));
        mesh.normals.push_back(dice.unit());
        mesh.uvs.emplace_back(dice(-0.01f, 0.01f), dice(-3, 3));
        const glm::vec3 t = glm::normalize(glm::cross(mesh.normals[i], glm::vec3(0.3f, 1.0f, 0.2f)));
        mesh.tangents.emplace_back(t, i % 2 == 0 ? 1.0f : -1.0f);
        if (i % 3 == 2) mesh.triangles.emplace_back(i, i - 1, i - 2);
    }
    mesh.positions[7] = {-0.0f, 1e-30f, 1e18f};
    mesh.uvs[3] = {0.1f, -0.0f};
    return mesh;
}

Mesh makeQuadrics(Dice& dice, uint32_t material) {
    Mesh mesh{.name = "quadrics", .material = material};
    for (const QuadricKind kind : {QuadricKind::ellipsoid, QuadricKind::cylinder, QuadricKind::cone,
                                   QuadricKind::hyperboloid, QuadricKind::paraboloid})
        mesh.quadrics.push_back({kind, dice.vec(0.5f, 2.0f), dice(-0.4f, 0.1f), dice(0.2f, 0.4f)});
    return mesh;
}

Material makeMaterial(Dice& dice, const std::string& name) {
    Material material{.name = name};
    material.baseColor = dice.vec(0, 1);
    material.alpha = dice(0, 1);
    material.metallic = dice(0, 1);
    material.roughness = dice(0, 1);
    material.emission = dice.vec(0, 1000);
    material.alphaCutoff = dice(0, 1);
    material.transmission = dice(0, 1);
    material.ior = dice(1, 3);
    material.specular = dice(0, 1);
    material.specularColor = dice.vec(0, 2);
    material.clearcoat = dice(0, 1);
    material.clearcoatRoughness = dice(0, 1);
    material.sheenColor = dice.vec(0, 1);
    material.sheenRoughness = dice(0, 1);
    material.anisotropy = dice(0, 1);
    material.anisotropyRotationRadians = dice(-3, 3);
    material.attenuationColor = dice.vec(0, 1);
    material.attenuationDistance = dice(0.1f, 9);
    material.priority = static_cast<uint32_t>(dice(1, 100));
    return material;
}

void addSize(Dice& dice, Light& light, bool isSunDisc) {
    if (light.kind == LightKind::sphere || light.kind == LightKind::disc) light.radius = dice(0.1f, 9);
    if (light.kind == LightKind::directional && isSunDisc) light.angularRadiusRadians = dice(0, 1.5f);
    if (light.kind != LightKind::rectangle) return;
    light.size = {dice(0.1f, 9), dice(0.1f, 9)};
    light.tangent = glm::normalize(glm::cross(light.direction, dice.unit()));
}

void addSurroundings(Dice& dice, Scene& scene) {
    for (int i = 0; i < 40; ++i) {
        Camera camera{.name = "camera " + std::to_string(i), .position = dice.vec(-9, 9), .target = dice.vec(20, 90)};
        camera.fovYRadians = dice(0.1f, 3.0f);
        if (i % 2 == 1) camera.up = dice.unit();
        scene.cameras.push_back(camera);
        Light light{.name = "light " + std::to_string(i), .kind = static_cast<LightKind>(i % 6)};
        light.position = dice.vec(-9, 9);
        light.direction = dice.unit();
        light.intensity = dice.vec(0, 1) * std::exp2(dice(-20, 60));
        if (light.kind == LightKind::spot) {
            light.innerConeRadians = dice(0, 0.5f);
            light.outerConeRadians = dice(0.5f, 1.5f);
        }
        addSize(dice, light, i > 20);
        scene.lights.push_back(light);
    }
    Environment environment{.radiance = Bitmap(8, 4, 3)};
    for (float& value : environment.radiance.pixels) value = std::exp2(dice(-30, 30));
    scene.environment = environment;
    scene.sky = SkyDescription{dice(-1.5f, 1.5f), dice(-6, 6), dice(1, 10), dice(0, 100)};
}

/// Everything that a scene can hold, in the order in which the importer puts it.
Scene everything() {
    Dice dice;
    Scene scene;
    scene.name = "every thing 100%";
    scene.textures = {makeTexture(dice, "colour", true, false, Wrap::repeat, Wrap::mirror),
                      makeTexture(dice, "Mörtel/rough \"ness\"", false, true, Wrap::clamp, Wrap::mirror),
                      makeTexture(dice, "colour", false, false, Wrap::clamp, Wrap::mirror),
                      makeTexture(dice, "glow", true, true, Wrap::mirror, Wrap::clamp)};
    // In the order in which a material names them: roles of data and of colour.
    for (const bool isColor : {false, false, false, true, true, false, true, true, false, false})
        scene.textures.push_back(makeTexture(dice, "lobe " + std::to_string(scene.textures.size()), isColor, false,
                                             Wrap::repeat, Wrap::clamp));
    for (const char* name : {"textured", "plain", "", "plain"}) scene.materials.push_back(makeMaterial(dice, name));
    scene.materials[3].phong = PhongMaterial{dice.vec(0, 1), dice.vec(0, 1), dice(1, 200), dice.vec(0, 1),
                                             dice.vec(0, 1), dice(0, 1),     dice(1, 10000)};
    Material& textured = scene.materials[0];
    textured.baseColorTexture = 0;
    textured.metallicRoughnessTexture = 1;
    textured.normalTexture = 2;
    textured.emissionTexture = 3;
    textured.normalScale = dice(0, 2);
    textured.lobeTextures = {4, 5, 6, dice(0, 2), 7, 8, 9, 10, 11, 12, 13};
    textured.alphaMode = AlphaMode::mask;
    scene.materials[1].alphaMode = AlphaMode::blend;
    scene.materials[1].baseColorTexture = 3;
    scene.materials[2].doubleSided = true;
    scene.materials[2].thin = false;
    scene.materials[2].thickness = dice(0.1f, 9);
    scene.materials[2].emission = {8.0f, 0.0f, 1.0f};
    scene.materials[2].anisotropy = 0.0f;  // an anisotropic one has the importer make the tangents that its mesh lacks
    scene.materials[2].anisotropyRotationRadians = 0.0f;
    scene.meshes = {makeMesh(dice, "a", 0), makeMesh(dice, "b", 1), makeMesh(dice, "a", 2), makeQuadrics(dice, 3)};
    scene.meshes[1].tangents.clear();
    scene.meshes[1].uvs.clear();
    scene.meshes[2].normals.clear();
    scene.meshes[2].tangents.clear();
    for (const uint32_t mesh : {3u, 0u, 1u, 0u, 3u, 2u})
        scene.instances.push_back({"shows " + std::to_string(mesh), mesh, dice.affine()});
    scene.instances[1].objectToWorld = glm::mat4(1.0f);
    for (const size_t moving : {0, 1, 5}) scene.instances[moving].endToWorld = dice.affine();
    addSurroundings(dice, scene);
    return scene;
}

nlohmann::json documentOf(const fs::path& gltf) {
    std::ifstream stream(gltf, std::ios::binary);
    return nlohmann::json::parse(stream);
}

/// import(save(scene)), by way of both forms of the format.
void expectLossless(const Scene& scene, const ScratchFolder& folder) {
    for (const char* extension : {".gltf", ".glb"}) {
        SCOPED_TRACE(extension);
        const fs::path file = folder.path() / (scene.name + extension);
        saveGltf(scene, file);
        const Scene again = importScene(file);
        EXPECT_TRUE(again.warnings.empty()) << joined(again.warnings);
        expectSameScene(scene, again);
    }
}

TEST(SaveGltf, KeepsEveryBitOfEveryFeature) {
    SCOPED_TRACE("seed " + std::to_string(kSeed));
    expectLossless(everything(), ScratchFolder());
}

TEST(SaveGltf, KeepsTheLimitsOfTheSun) {
    const ScratchFolder folder;
    Scene scene = everything();
    scene.sky = SkyDescription{glm::radians(90.0f), -glm::radians(360.0f), 1.0f, 0.0f};
    saveGltf(scene, folder.path() / "s.glb");
    expectSameBits(*importScene(folder.path() / "s.glb").sky, *scene.sky, "sky");
}

TEST(SaveGltf, KeepsRaylabsOwnScenes) {
    const ScratchFolder folder;
    size_t count = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(support::binaryFolder() / "assets")) {
        if (entry.path().extension() != ".glb") continue;
        SCOPED_TRACE(entry.path().string());
        expectLossless(importScene(entry.path()), folder);
        ++count;
    }
    EXPECT_GE(count, 2u);
}

/// Exporters of all kinds: quantised and interleaved vertices, scaled and sheared nodes, scans, Phong materials.
TEST(SaveGltf, KeepsScenesOfOthers) {
    SKIP_WITHOUT_SCENE(kScenes);
    const ScratchFolder folder;
    for (const char* name :
         {"cornell-box/tungsten/cornell-tungsten.glb", "hyperion/hyperion/glass.obj", "malformed-assimp/OBJ/spider.obj",
          "malformed-assimp/PLY/cube_uv.ply", "smallpine/scene.gltf", "water-caustic/water-caustic.glb",
          "materialtest-envmap/materialtest.glb", "derived-edge-cases/truck_nonuniform_sheared.gltf",
          "derived-edge-cases/box_nan_normal.glb"}) {
        if (!fs::exists(kScenes / name)) continue;
        SCOPED_TRACE(name);
        expectLossless(importScene(kScenes / name), folder);
    }
}

TEST(SaveGltf, KeepsTheSampleModels) {
    SKIP_WITHOUT_SCENE(kScenes / "gltf-features");
    const ScratchFolder folder;
    size_t count = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kScenes / "gltf-features")) {
        const fs::path extension = entry.path().extension();
        if (extension != ".gltf" && extension != ".glb") continue;
        SCOPED_TRACE(entry.path().string());
        expectLossless(importScene(entry.path()), folder);
        ++count;
    }
    EXPECT_GE(count, 10u);
}

TEST(SaveGltf, KeepsSponzaAndTheDragon) {
    const ScratchFolder folder;
    for (const char* name : {"sponza-crytek/Sponza.gltf", "stanford-dragon/dragon_vrip.ply"}) {
        SKIP_WITHOUT_SCENE(kScenes / name);
        SCOPED_TRACE(name);
        const Scene scene = importScene(kScenes / name);
        const fs::path file = folder.path() / (scene.name + ".glb");
        saveGltf(scene, file);
        expectSameScene(scene, importScene(file));
    }
}

/// Assimp's whole glTF reader, which ours uses for vertices alone.
TEST(SaveGltf, AssimpReadsTheSame) {
    const ScratchFolder folder;
    Scene scene = everything();
    saveGltf(scene, folder.path() / "a.glb");
    Assimp::Importer importer;
    const aiScene* read = importer.ReadFile((folder.path() / "a.glb").string(), aiProcess_ValidateDataStructure);
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    ASSERT_EQ(read->mNumMeshes, 3u) << "a mesh that two nodes show is stored once; quadrics are no meshes to others";
    for (unsigned m = 0; m < 3; ++m) {
        const Mesh& mesh = scene.meshes[m];
        ASSERT_EQ(read->mMeshes[m]->mNumVertices, mesh.positions.size());
        ASSERT_EQ(read->mMeshes[m]->mNumFaces, mesh.triangles.size());
        for (unsigned f = 0; f < read->mMeshes[m]->mNumFaces; ++f)
            for (int c = 0; c < 3; ++c)  // vertices may have other numbers
                EXPECT_EQ(std::memcmp(&read->mMeshes[m]->mVertices[read->mMeshes[m]->mFaces[f].mIndices[c]],
                                      &mesh.positions[mesh.triangles[f][c]], sizeof(glm::vec3)),
                          0);
    }
    EXPECT_GE(read->mNumTextures, 11u) << "of the fourteen; Assimp 5.2 does not know those of anisotropy and specular";
    ASSERT_EQ(read->mNumLights, 40u);
    EXPECT_EQ(read->mLights[2]->mType, aiLightSource_SPOT);
    ASSERT_EQ(read->mNumCameras, 40u);
    const aiNode* node = read->mRootNode->FindNode("shows 2");
    ASSERT_NE(node, nullptr);
    EXPECT_EQ(node->mTransformation.b4, scene.instances[5].objectToWorld[3][1]);
    EXPECT_EQ(node->mTransformation.c1, scene.instances[5].objectToWorld[0][2]);
}

/// Somebody turns the camera in another program, which keeps our extras.
TEST(SaveGltf, AMovedCameraIsNotPutBack) {
    const ScratchFolder folder;
    const Scene scene = everything();
    saveGltf(scene, folder.path() / "s.gltf");
    nlohmann::json document = documentOf(folder.path() / "s.gltf");
    for (nlohmann::json& node : document["nodes"])
        if (node.contains("camera")) node["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1};
    const Scene moved = importScene(folder.write("s.gltf", document.dump()));
    ASSERT_EQ(moved.cameras.size(), scene.cameras.size());
    for (const Camera& camera : moved.cameras) {
        EXPECT_EQ(camera.position, glm::vec3(1, 2, 3));
        expectNear(glm::normalize(camera.target - camera.position), {0, 0, -1});
        EXPECT_EQ(camera.up, glm::vec3(0, 1, 0));
    }
}

/// What JSON schema validators of glTF insist on.
TEST(SaveGltf, StaysWithinTheRangesOfTheFormat) {
    const ScratchFolder folder;
    saveGltf(everything(), folder.path() / "s.gltf");
    const nlohmann::json document = documentOf(folder.path() / "s.gltf");
    for (const nlohmann::json& material : document["materials"])
        for (const double factor : material["emissiveFactor"]) EXPECT_LE(factor, 1.0);
    for (const nlohmann::json& light : document["extensions"]["KHR_lights_punctual"]["lights"])
        for (const double channel : light["color"]) EXPECT_LE(channel, 1.0);
    for (const nlohmann::json& view : document["bufferViews"]) EXPECT_EQ(view["byteOffset"].get<size_t>() % 4, 0u);
    EXPECT_EQ(document["samplers"].size(), 4u) << "the ten textures of lobes share one, and two of the four others";
    for (const char* name : {"KHR_lights_punctual", "KHR_materials_anisotropy", "KHR_materials_clearcoat",
                             "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_sheen", "KHR_materials_specular", "KHR_materials_transmission", "KHR_materials_volume"})
        EXPECT_EQ(std::count(document["extensionsUsed"].begin(), document["extensionsUsed"].end(), name), 1) << name;
    EXPECT_EQ(document["buffers"][0]["byteLength"].get<size_t>(), fs::file_size(folder.path() / "s.bin"));
}

TEST(SaveGltf, ReportsTheFilesItWrote) {
    const ScratchFolder folder;
    const std::vector<SavedFile> files = saveGltf(everything(), folder.path() / "s.gltf");
    size_t onDisk = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.path())) onDisk += entry.file_size();
    size_t reported = 0;
    for (const SavedFile& file : files) reported += file.bytes;
    EXPECT_EQ(files.size(), 17u) << "radiance map, fourteen images, buffer, document";
    EXPECT_EQ(reported, onDisk);
    EXPECT_EQ(files.back().path, folder.path() / "s.gltf");
}

/// A folder bears the name of the buffer, so it cannot be written: the document that would name it must not change.
TEST(SaveGltf, AFailureLeavesTheOldDocumentAndNoTemporaries) {
    const ScratchFolder folder;
    folder.write("s.gltf", "the user's own");
    fs::create_directories(folder.path() / "s.bin" / "in the way");
    EXPECT_THROW(saveGltf(everything(), folder.path() / "s.gltf"), Error);
    std::ifstream stream(folder.path() / "s.gltf");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stream), {}), "the user's own");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.path()))
        EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
}

TEST(SaveGltf, RefusesOtherExtensions) {
    const ScratchFolder folder;
    EXPECT_THROW(saveGltf(everything(), folder.path() / "s.obj"), Error);
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(SaveGltf, NamesThatAreNoUtf8AreReplaced) {
    const ScratchFolder folder;
    Scene scene = everything();
    scene.instances[0].name = "caf\xe9";
    saveGltf(scene, folder.path() / "s.glb");
    EXPECT_EQ(importScene(folder.path() / "s.glb").instances[0].name, "caf\xef\xbf\xbd");
}

}  // namespace
}  // namespace raylab::importtest
