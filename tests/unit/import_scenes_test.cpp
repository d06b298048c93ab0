#include <algorithm>
#include <sys/wait.h>

#include "engine/scene/bounds.h"
#include "engine/scene/mesh_shading.h"
#include "import_support.h"

namespace raylab::importtest {
namespace {

nlohmann::json jsonOf(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (text.starts_with("glTF")) {
        uint32_t length = 0;
        std::memcpy(&length, text.data() + 12, 4);
        text = text.substr(20, length);
    }
    return nlohmann::json::parse(text);
}

/// Counts of the README of the shared scenes.
TEST(ImportRealScene, Sponza) {
    const fs::path path = kScenes / "sponza-crytek/Sponza.gltf";
    SKIP_WITHOUT_SCENE(path);
    const Scene scene = importScene(path);
    expectSound(scene);
    EXPECT_EQ(triangleCount(scene).stored, 262267u);
    EXPECT_EQ(scene.meshes.size(), 103u);
    EXPECT_EQ(scene.materials.size(), 25u);
    EXPECT_EQ(scene.textures.size(), 69u);
    EXPECT_TRUE(scene.warnings.empty()) << joined(scene.warnings);
}

/// The tangents in a file, written by somebody's exporter, against our own. They differ where smoothing groups or
/// mirrored halves meet, so the agreement is statistical. The handedness is not compared: all three come from exporters
/// that ran MikkTSpace with V upwards and so have it turned round (KhronosGroup/glTF-Sample-Models, issues 174 and
/// 262).
TEST(ImportRealScene, TangentsAgreeWithTheExporters) {
    for (const char* name :
         {"sponza-crytek/Sponza.gltf", "smallpine/scene.gltf", "gltf-features/TwoSidedPlane/glTF/TwoSidedPlane.gltf"}) {
        SKIP_WITHOUT_SCENE(kScenes / name);
        const Scene scene = importScene(kScenes / name);
        size_t count = 0, same = 0;
        for (const Mesh& mesh : scene.meshes) {
            if (mesh.tangents.empty()) continue;
            const std::vector<glm::vec4> ours = vertexTangents(mesh.positions, mesh.normals, mesh.uvs, mesh.triangles);
            count += ours.size();
            for (size_t i = 0; i < ours.size(); ++i)
                same += glm::dot(glm::vec3(ours[i]), glm::vec3(mesh.tangents[i])) > 0.9f;
        }
        ASSERT_GT(count, 0u) << name;
        EXPECT_GT(static_cast<double>(same), 0.9 * static_cast<double>(count)) << name;
    }
}

/// No UV of this model is mirrored, and issue 174 settles that it looks right with w = +1, wrong with -1.
TEST(ImportRealScene, HandednessOfTheNormalTangentTest) {
    const fs::path path = kScenes / "gltf-features/NormalTangentTest/glTF-Binary/NormalTangentTest.glb";
    SKIP_WITHOUT_SCENE(path);
    const Scene scene = importScene(path);
    const std::vector<glm::vec4>& tangents = scene.meshes.at(0).tangents;
    const auto positive = std::count_if(tangents.begin(), tangents.end(), [](glm::vec4 t) { return t.w > 0.0f; });
    EXPECT_GT(static_cast<double>(positive), 0.99 * static_cast<double>(tangents.size()));
}

TEST(ImportRealScene, Dragon) {
    const fs::path path = kScenes / "stanford-dragon/dragon_vrip.ply";
    SKIP_WITHOUT_SCENE(path);
    const Scene scene = importScene(path);
    expectSound(scene);
    EXPECT_EQ(triangleCount(scene).stored, 871414u);
    EXPECT_EQ(scene.meshes.at(0).normals.size(), scene.meshes[0].positions.size());
}

TEST(ImportRealScene, HouseAndItsCamera) {
    const fs::path path = kScenes / "victorian-house/house.glb";
    SKIP_WITHOUT_SCENE(path);
    const Scene scene = importScene(path);
    expectSound(scene);
    EXPECT_EQ(triangleCount(scene).stored, 1571178u);
    EXPECT_EQ(scene.meshes.size(), 270u);
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& camera = scene.cameras[0];
    expectNear(camera.position, {-22.8679f, 3.71045f, 19.4895f}, 1e-4f);
    EXPECT_FLOAT_EQ(camera.fovYRadians, 0.35106062f);
    // Minus the third column of the node's matrix.
    expectNear(glm::normalize(camera.target - camera.position), {0.58531121f, -0.03034816f, -0.81024057f}, 1e-5f);
    EXPECT_TRUE(std::any_of(scene.materials.begin(), scene.materials.end(),
                            [](const Material& m) { return m.name == "Glass" && m.transmission == 1.0f && m.thin; }));
}

TEST(ImportRealScene, WaterCausticMaterialsAndCamera) {
    const fs::path path = kScenes / "water-caustic/water-caustic.glb";
    SKIP_WITHOUT_SCENE(path);
    const Scene scene = importScene(path);
    expectSound(scene);
    EXPECT_EQ(triangleCount(scene).stored, 103487u);
    const auto named = [&scene](const std::string& name) {
        return *std::find_if(scene.materials.begin(), scene.materials.end(),
                             [&name](const Material& m) { return m.name == name; });
    };
    EXPECT_FLOAT_EQ(named("water").ior, 1.8f);
    EXPECT_FALSE(named("water").thin);
    EXPECT_EQ(named("water").transmission, 1.0f);
    EXPECT_FLOAT_EQ(named("light").emission.x, 541126.806512444f);
    expectNear(scene.cameras.at(0).position, {-1.03263e-06f, 0.990944f, 6.83879f});
    expectNear(glm::normalize(scene.cameras[0].target - scene.cameras[0].position), {0, 0, -1}, 1e-5f);
}

TEST(ImportRealScene, CamerasOfTheSampleModel) {
    const fs::path path = kScenes / "gltf-features/Cameras/glTF/Cameras.gltf";
    SKIP_WITHOUT_SCENE(path);
    const Scene scene = importScene(path);
    ASSERT_EQ(scene.cameras.size(), 1u) << "the orthographic one is left out";
    EXPECT_TRUE(anyContains(scene.warnings, "orthographic"));
    expectNear(scene.cameras[0].position, {0.5f, 0.5f, 3.0f});
    EXPECT_FLOAT_EQ(scene.cameras[0].fovYRadians, jsonOf(path)["cameras"][0]["perspective"]["yfov"].get<float>());
}

TEST(ImportRealScene, InstancesAreShared) {
    const fs::path path = kScenes / "gltf-features/2CylinderEngine/glTF-Binary/2CylinderEngine.glb";
    SKIP_WITHOUT_SCENE(path);
    const Scene scene = importScene(path);
    expectSound(scene);
    EXPECT_EQ(triangleCount(scene).instanced, 121496u);
    EXPECT_LT(triangleCount(scene).stored, triangleCount(scene).instanced);
}

TEST(ImportRealScene, MissingTextureOfThePine) {
    const fs::path path = kScenes / "smallpine/scene.gltf";
    SKIP_WITHOUT_SCENE(path);
    const Scene scene = importScene(path);
    expectSound(scene);
    ASSERT_EQ(scene.warnings.size(), 1u) << joined(scene.warnings);
    EXPECT_NE(scene.warnings[0].find("M_TreeAtlas_normal.png"), std::string::npos);
}

/// Each edit of the box damages exactly one thing.
TEST(ImportRealScene, EdgeCasesAreCounted) {
    const fs::path folder = kScenes / "derived-edge-cases";
    SKIP_WITHOUT_SCENE(folder);
    const std::pair<const char*, const char*> cases[] = {{"box_nan_vertex.glb", "not finite or beyond 1e18: 1"},
                                                         {"box_inf_vertex.glb", "not finite or beyond 1e18: 1"},
                                                         {"box_huge_vertex_1e30.glb", "not finite or beyond 1e18: 1"},
                                                         {"box_index_oob.glb", "do not exist: 1"},
                                                         {"box_nan_normal.glb", "computed from the triangles: 1"},
                                                         {"box_nan_uv.glb", "set to 0: 1"}};
    for (const auto& [name, warning] : cases) {
        const Scene scene = importScene(folder / name);
        expectSound(scene);
        ASSERT_EQ(scene.warnings.size(), 1u) << name << ": " << joined(scene.warnings);
        EXPECT_NE(scene.warnings[0].find(warning), std::string::npos) << name << ": " << scene.warnings[0];
    }
    EXPECT_NE(errorOf(folder / "box_truncated_half.glb").find("truncated"), std::string::npos);
    EXPECT_NE(errorOf(folder / "box_truncated_20bytes.glb").find("truncated"), std::string::npos);
    EXPECT_NE(errorOf(folder / "truck_singular.gltf").find("singular"), std::string::npos);
}

/// What the importer does to a file, seen from outside the process.
enum class Outcome { read, refused, crashed, hung };

Outcome outcomeOf(const fs::path& path) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::alarm(10);
        try {
            importScene(path);
        } catch (const Error&) {
            ::_exit(1);
        } catch (...) {
            ::_exit(2);
        }
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGALRM ? Outcome::hung : Outcome::crashed;
    return WEXITSTATUS(status) == 0 ? Outcome::read : WEXITSTATUS(status) == 1 ? Outcome::refused : Outcome::crashed;
}

/// Every file of the folders, whatever it is: read or refused with an Error, in ten seconds.
TEST(ImportRealScene, NothingCrashesOrHangs) {
    SKIP_WITHOUT_SCENE(kScenes);
    size_t count = 0;
    for (const char* folder : {"malformed-assimp", "derived-edge-cases", "gltf-features"})
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kScenes / folder)) {
            if (!entry.is_regular_file()) continue;
            ++count;
            const Outcome outcome = outcomeOf(entry.path());
            EXPECT_NE(outcome, Outcome::crashed) << entry.path();
            EXPECT_NE(outcome, Outcome::hung) << entry.path();
        }
    EXPECT_GT(count, 150u);
}

}  // namespace
}  // namespace raylab::importtest
