#include <cmath>
#include <limits>

#include "import_support.h"

namespace raylab::importtest {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(ImportGltf, ComposesNodeTransformsAndStoresASharedMeshOnce) {
    const ScratchFolder folder;
    Gltf gltf;
    gltf.mesh(gltf.trianglePrimitive());
    const double half = std::sqrt(0.5);
    gltf.json["scenes"] = {{{"nodes", {0}}}};
    gltf.json["nodes"] = {{{"translation", {10, 0, 0}}, {"children", {1, 2}}},
                          {{"mesh", 0}, {"rotation", {0, 0, half, half}}, {"scale", {2, 3, 4}}},  // 90 degrees about Z
                          {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1}}}};
    const Scene scene = importScene(gltf.write(folder));
    expectSound(scene);
    ASSERT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    const auto apply = [&](size_t i, glm::vec3 p) {
        return glm::vec3(scene.instances[i].objectToWorld * glm::vec4(p, 1));
    };
    expectNear(apply(0, {1, 1, 1}), {10 - 3, 2, 4}, 1e-5f);  // x to y, y to -x
    expectNear(apply(1, {1, 1, 1}), {16, 7, 8});
}

TEST(ImportGltf, GlbEqualsGltf) {
    const ScratchFolder folder;
    Gltf gltf;
    gltf.mesh(gltf.trianglePrimitive());
    const Scene text = importScene(gltf.write(folder));
    const Scene binary = importScene(folder.write("scene.glb", gltf.glb()));
    EXPECT_EQ(text.meshes[0].positions, binary.meshes[0].positions);
    EXPECT_EQ(text.meshes[0].uvs, binary.meshes[0].uvs);
    EXPECT_EQ(text.meshes[0].triangles, binary.meshes[0].triangles);
    EXPECT_EQ(text.meshes[0].uvs[2], glm::vec2(0, 1)) << "v grows downwards in the file and in Scene";
}

TEST(ImportGltf, DataUriBuffer) {
    const ScratchFolder folder;
    Gltf gltf;
    gltf.mesh({{"attributes", {{"POSITION", gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
    nlohmann::json document = gltf.json;
    // Nine floats; 1.0f is 00 00 80 3f. Encoded with coreutils' base64.
    const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    document["buffers"] = {{{"uri", "data:application/octet-stream;base64," + base64}, {"byteLength", 36}}};
    const Scene scene = importScene(folder.write("inline.gltf", document.dump()));
    EXPECT_EQ(scene.meshes[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(ImportGltf, WithoutNormalsIsFlatAndWithoutMaterialIsGrey) {
    const ScratchFolder folder;
    Gltf gltf;
    gltf.mesh(gltf.trianglePrimitive());
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_TRUE(scene.meshes[0].normals.empty());
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec3(0.8f));
    EXPECT_EQ(scene.materials[0].specular, 0.0f);
    EXPECT_EQ(scene.materials[0].metallic, 0.0f);
    EXPECT_TRUE(scene.warnings.empty()) << joined(scene.warnings);
}

/// glTF 2.0, section 3.7.2.1: triangle i of a strip is {v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]}; a fan's is {v[i+1],
/// v[i+2], v[0]}.
TEST(ImportGltf, StripsAndFansKeepTheirWinding) {
    const ScratchFolder folder;
    for (const int mode : {5, 6}) {
        Gltf gltf;
        const std::vector<float> strip = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
        const std::vector<float> fan = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0};
        gltf.mesh({{"attributes", {{"POSITION", gltf.positions(mode == 5 ? strip : fan)}}}, {"mode", mode}});
        const Scene scene = importScene(gltf.write(folder));
        const Mesh& mesh = scene.meshes[0];
        ASSERT_EQ(mesh.triangles.size(), 3u);
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
            EXPECT_FLOAT_EQ(glm::cross(b - a, c - a).z, 1.0f) << "mode " << mode;
        }
    }
}

TEST(ImportGltf, NormalisedIntegerTextureCoordinatesAndQuantisedPositions) {
    const ScratchFolder folder;
    Gltf gltf;
    const size_t uv = gltf.accessor<uint16_t>({0, 0, 65535, 0, 0, 13107}, 5123, "VEC2", 3, true);
    const size_t position =
        gltf.accessor<int16_t>({0, 0, 0, 0, 32767, 0, 0, 0, 0, -32768, 0, 0}, 5122, "VEC3", 3, true);
    gltf.json["bufferViews"].back()["byteStride"] = 8;
    gltf.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    gltf.mesh({{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}});
    const Scene scene = importScene(gltf.write(folder));
    const Mesh& mesh = scene.meshes[0];
    EXPECT_NEAR(mesh.uvs[1].x, 1.0f, 1e-7f);
    EXPECT_NEAR(mesh.uvs[2].y, 0.2f, 1e-6f);  // 13107 / 65535
    EXPECT_EQ(mesh.positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(mesh.positions[2], glm::vec3(0, -1, 0)) << "-32768 is clamped to -1";
}

/// Interleaved without padding after the last element, which the specification allows and Assimp 5.2.5 refuses.
TEST(ImportGltf, InterleavedViewThatEndsWithItsLastElement) {
    const ScratchFolder folder;
    Gltf gltf;
    std::vector<float> both;
    for (int i = 0; i < 3; ++i) {
        const float x = i == 1 ? 1.0f : 0.0f, y = i == 2 ? 1.0f : 0.0f;
        both.insert(both.end(), {0, 0, 1, x, y, 0});  // normal, position
    }
    const size_t normal = gltf.accessor(both, 5126, "VEC3", 3);
    gltf.json["bufferViews"].back()["byteStride"] = 24;
    gltf.json["accessors"].push_back(gltf.json["accessors"].back());
    gltf.json["accessors"].back()["byteOffset"] = 12;
    gltf.mesh({{"attributes", {{"NORMAL", normal}, {"POSITION", normal + 1}}}});
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_EQ(scene.meshes[0].positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(scene.meshes[0].normals, std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
}

TEST(ImportGltf, SparseAccessorReplacesElements) {
    const ScratchFolder folder;
    Gltf gltf;
    const size_t position = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    gltf.accessor<uint16_t>({2}, 5123, "SCALAR", 1);
    gltf.accessor<float>({5, 6, 7}, 5126, "VEC3", 1);
    gltf.json["accessors"][position]["sparse"] = {
        {"count", 1}, {"indices", {{"bufferView", 1}, {"componentType", 5123}}}, {"values", {{"bufferView", 2}}}};
    gltf.mesh({{"attributes", {{"POSITION", position}}}});
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_EQ(scene.meshes[0].positions[1], glm::vec3(1, 0, 0));
    EXPECT_EQ(scene.meshes[0].positions[2], glm::vec3(5, 6, 7));
}

TEST(ImportGltf, TrianglesWithBadVerticesGoAndAreCounted) {
    const ScratchFolder folder;
    Gltf gltf;
    const size_t position = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, kNan, 0, 0, 1e30f, 0, 0, 1, 1, 0});
    const size_t uv = gltf.accessor<float>({0, 0, kNan, 0, 0, 1, 0, 0, 0, 0, 1, 1}, 5126, "VEC2", 6);
    const size_t indices = gltf.indices({0, 1, 2, 0, 1, 3, 0, 1, 4, 1, 5, 2, 0, 1, 77});
    gltf.mesh({{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}, {"indices", indices}});
    const Scene scene = importScene(gltf.write(folder));
    expectSound(scene);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
    EXPECT_EQ(scene.meshes[0].positions.size(), 4u);
    EXPECT_EQ(scene.meshes[0].uvs[1], glm::vec2(0));
    EXPECT_TRUE(anyContains(scene.warnings, "not finite or beyond 1e18: 2")) << joined(scene.warnings);
    EXPECT_TRUE(anyContains(scene.warnings, "vertices which do not exist: 1")) << joined(scene.warnings);
    EXPECT_TRUE(anyContains(scene.warnings, "texture coordinates that were not finite, set to 0: 1"));
}

TEST(ImportGltf, BadNormalsAreRecomputedFromTheTriangles) {
    const ScratchFolder folder;
    Gltf gltf;
    nlohmann::json primitive = gltf.trianglePrimitive();
    primitive["attributes"]["NORMAL"] = gltf.accessor<float>({0, 3, 0, kNan, 0, 0, 0, 0, 0}, 5126, "VEC3", 3);
    gltf.mesh(primitive);
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_EQ(scene.meshes[0].normals, (std::vector<glm::vec3>{{0, 1, 0}, {0, 0, 1}, {0, 0, 1}}));
    EXPECT_TRUE(anyContains(scene.warnings, "computed from the triangles: 2")) << joined(scene.warnings);
}

TEST(ImportGltf, SingularInstancesAreNamedAndLeftOut) {
    const ScratchFolder folder;
    Gltf gltf;
    gltf.mesh(gltf.trianglePrimitive());
    gltf.json["scenes"] = {{{"nodes", {0, 1, 2, 3}}}};
    gltf.json["nodes"] = {{{"mesh", 0}, {"name", "good"}},
                          {{"mesh", 0}, {"name", "flat"}, {"scale", {1, 0, 1}}},
                          {{"mesh", 0}, {"name", "tiny"}, {"scale", {1e-6, 1e-6, 1e-6}}},
                          {{"mesh", 0}, {"name", "mirrored"}, {"scale", {-1, 1, 1}}}};
    const Scene scene = importScene(gltf.write(folder));
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_TRUE(anyContains(scene.warnings, "transform: 1: \"flat\"")) << joined(scene.warnings);
    EXPECT_LT(glm::determinant(scene.instances[2].objectToWorld), 0.0f);
}

TEST(ImportGltf, PointsAndLinesAreCounted) {
    const ScratchFolder folder;
    Gltf gltf;
    nlohmann::json triangle = gltf.trianglePrimitive();
    nlohmann::json points = triangle, lines = triangle;
    points["mode"] = 0;
    lines["mode"] = 3;
    gltf.json["meshes"] = {{{"primitives", {triangle, points, lines}}}};
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_TRUE(anyContains(scene.warnings, "points and lines left out")) << joined(scene.warnings);
}

TEST(ImportGltf, CamerasLookAlongMinusZOfTheirNode) {
    const ScratchFolder folder;
    Gltf gltf;
    gltf.mesh(gltf.trianglePrimitive());
    const double half = std::sqrt(0.5);
    gltf.json["scenes"] = {{{"nodes", {0, 1}}}};
    gltf.json["nodes"].push_back(
        {{"camera", 0}, {"translation", {1, 2, 3}}, {"rotation", {0, half, 0, half}}, {"scale", {5, 5, 5}}});
    gltf.json["cameras"] = {{{"type", "perspective"},
                             {"name", "eye"},
                             {"perspective", {{"yfov", 0.5}, {"znear", 0.1}, {"aspectRatio", 2}}}}};
    const Scene scene = importScene(gltf.write(folder));
    ASSERT_EQ(scene.cameras.size(), 1u);
    const Camera& camera = scene.cameras[0];
    EXPECT_EQ(camera.name, "eye");
    expectNear(camera.position, {1, 2, 3});
    expectNear(glm::normalize(camera.target - camera.position), {-1, 0, 0});  // -Z turned by 90 degrees about Y
    expectNear(camera.up, {0, 1, 0});
    EXPECT_FLOAT_EQ(camera.fovYRadians, 0.5f) << "the file's vertical angle, whatever its aspect ratio";
}

TEST(ImportGltf, PunctualLights) {
    const ScratchFolder folder;
    Gltf gltf;
    gltf.mesh(gltf.trianglePrimitive());
    const double half = std::sqrt(0.5);
    gltf.json["extensionsUsed"] = {"KHR_lights_punctual"};
    gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 20}, {"color", {1, 0.5, 0}}},
        {{"type", "directional"}, {"intensity", 3}},
        {{"type", "spot"}, {"intensity", 7}, {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.4}}}},
        {{"type", "point"}, {"intensity", -1}}};
    gltf.json["scenes"] = {{{"nodes", {0, 1, 2, 3, 4}}}};
    for (int i = 0; i < 4; ++i)
        gltf.json["nodes"].push_back({{"translation", {i, 2, 3}},
                                      {"rotation", {-half, 0, 0, half}},  // -Z turned to -Y
                                      {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    const Scene scene = importScene(gltf.write(folder));
    ASSERT_EQ(scene.lights.size(), 4u);
    EXPECT_EQ(scene.lights[0].kind, LightKind::point);
    EXPECT_EQ(scene.lights[0].intensity, glm::vec3(20, 10, 0));
    expectNear(scene.lights[0].position, {0, 2, 3});
    EXPECT_EQ(scene.lights[1].kind, LightKind::directional);
    EXPECT_EQ(scene.lights[1].intensity, glm::vec3(3));
    expectNear(scene.lights[1].direction, {0, -1, 0});
    EXPECT_EQ(scene.lights[2].kind, LightKind::spot);
    EXPECT_FLOAT_EQ(scene.lights[2].innerConeRadians, 0.2f);
    EXPECT_FLOAT_EQ(scene.lights[2].outerConeRadians, 0.4f);
    EXPECT_EQ(scene.lights[3].intensity, glm::vec3(0));
    EXPECT_TRUE(anyContains(scene.warnings, "negative intensity"));
}

/// 40 levels that each scale by 1e10: beyond the range of a double.
TEST(ImportGltf, TransformsThatOverflowAreLeftOut) {
    const ScratchFolder folder;
    Gltf gltf;
    gltf.mesh(gltf.trianglePrimitive());
    gltf.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}}};
    gltf.json["nodes"] = {{{"mesh", 0}}};
    for (int i = 1; i <= 40; ++i)
        gltf.json["nodes"].push_back(
            {{"children", {i + 1}}, {"scale", {1e10, 1e10, 1e10}}, {"translation", {1, 0, 0}}});
    gltf.json["nodes"].push_back({{"mesh", 0}, {"camera", 0}});
    gltf.json["scenes"] = {{{"nodes", {0, 1}}}};
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_EQ(scene.instances.size(), 1u);
    EXPECT_TRUE(scene.cameras.empty());
    EXPECT_TRUE(anyContains(scene.warnings, "camera")) << joined(scene.warnings);
}

TEST(ImportGltf, ANodeWithTwoParentsIsPlacedTwice) {
    const ScratchFolder folder;
    Gltf gltf;
    gltf.mesh(gltf.trianglePrimitive());
    gltf.json["scenes"] = {{{"nodes", {0, 1}}}};
    gltf.json["nodes"] = {{{"children", {2}}}, {{"children", {2}}, {"translation", {0, 0, 9}}}, {{"mesh", 0}}};
    const Scene scene = importScene(gltf.write(folder));
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[1].objectToWorld[3], glm::vec4(0, 0, 9, 1));
}

/// 100,000 levels: recursion would overflow the stack.
TEST(ImportGltf, DeepHierarchy) {
    const ScratchFolder folder;
    Gltf gltf;
    gltf.mesh(gltf.trianglePrimitive());
    constexpr int kDepth = 100'000;
    gltf.json["nodes"] = nlohmann::json::array();
    for (int i = 0; i < kDepth; ++i) gltf.json["nodes"].push_back({{"children", {i + 1}}, {"translation", {0, 1, 0}}});
    gltf.json["nodes"].push_back({{"mesh", 0}});
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_EQ(scene.instances[0].objectToWorld[3], glm::vec4(0, kDepth, 0, 1));
}

}  // namespace
}  // namespace raylab::importtest
