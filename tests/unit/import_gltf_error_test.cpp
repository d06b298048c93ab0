#include "import_support.h"

namespace raylab::importtest {
namespace {

Gltf validGltf() {
    Gltf gltf;
    nlohmann::json primitive = gltf.trianglePrimitive();
    primitive["indices"] = gltf.indices({0, 1, 2});
    gltf.mesh(primitive);
    return gltf;
}

/// Applies `damage` to a valid document and expects an Error that names the file and contains `part`.
template <class Damage>
void expectError(const std::string& part, const Damage& damage) {
    const ScratchFolder folder;
    Gltf gltf = validGltf();
    damage(gltf);
    const std::string error = errorOf(gltf.write(folder));
    EXPECT_NE(error.find("scene.gltf"), std::string::npos) << error;
    EXPECT_NE(error.find(part), std::string::npos) << "expected \"" << part << "\" in: " << error;
}

TEST(ImportGltfError, TheUndamagedDocumentIsRead) {
    const ScratchFolder folder;
    EXPECT_EQ(errorOf(validGltf().write(folder)), "");
}

TEST(ImportGltfError, IndicesThatPointNowhere) {
    expectError("meshes[0].primitives[0].indices is 99",
                [](Gltf& g) { g.json["meshes"][0]["primitives"][0]["indices"] = 99; });
    expectError("attributes.POSITION must be an index",
                [](Gltf& g) { g.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -1; });
    expectError("nodes[0].mesh is 3", [](Gltf& g) { g.json["nodes"][0]["mesh"] = 3; });
    expectError("scenes[0].nodes[0] is 7", [](Gltf& g) { g.json["scenes"][0]["nodes"][0] = 7; });
    expectError("scene is 2", [](Gltf& g) { g.json["scene"] = 2; });
    expectError("accessors[0].bufferView is 50", [](Gltf& g) { g.json["accessors"][0]["bufferView"] = 50; });
    expectError("bufferViews[0].buffer is 9", [](Gltf& g) { g.json["bufferViews"][0]["buffer"] = 9; });
    expectError("primitives[0].material is 0", [](Gltf& g) { g.json["meshes"][0]["primitives"][0]["material"] = 0; });
}

TEST(ImportGltfError, RangesOutsideTheirBuffers) {
    expectError("accessors[0] needs 1000000", [](Gltf& g) { g.json["accessors"][0]["count"] = 1000000; });
    expectError("accessors[0] needs", [](Gltf& g) { g.json["accessors"][0]["byteOffset"] = 4; });
    expectError("accessors[0] needs", [](Gltf& g) { g.json["accessors"][0]["count"] = 8000000000000000; });
    expectError("bufferViews[0] reaches", [](Gltf& g) { g.json["bufferViews"][0]["byteLength"] = 100000; });
    expectError("bufferViews[1] reaches", [](Gltf& g) { g.json["bufferViews"][1]["byteOffset"] = 8000000000000000; });
    expectError("byteStride 4", [](Gltf& g) { g.json["bufferViews"][0]["byteStride"] = 4; });
    expectError("without a bufferView", [](Gltf& g) {
        g.json["accessors"][0].erase("bufferView");
        g.json["accessors"][0]["count"] = 4000000000;
    });
}

TEST(ImportGltfError, SparseIndexOutOfRange) {
    expectError("replaces element 3", [](Gltf& g) {
        g.indices({3});
        g.json["accessors"][0]["sparse"] = {
            {"count", 1}, {"indices", {{"bufferView", 3}, {"componentType", 5123}}}, {"values", {{"bufferView", 0}}}};
    });
}

TEST(ImportGltfError, Cycles) {
    expectError("is its own descendant", [](Gltf& g) {
        g.json["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
    });
    expectError("nodes[0] is its own descendant", [](Gltf& g) { g.json["nodes"][0]["children"] = {0}; });
}

/// 2^40 placements from 41 nodes.
TEST(ImportGltfError, ExponentialHierarchy) {
    expectError("share children more than a million times", [](Gltf& g) {
        g.json["nodes"] = nlohmann::json::array();
        for (int i = 0; i < 40; ++i) g.json["nodes"].push_back({{"children", {i + 1, i + 1}}});
        g.json["nodes"].push_back({{"mesh", 0}});
    });
}

TEST(ImportGltfError, WrongTypes) {
    expectError("materials[0].alphaCutoff must be a number", [](Gltf& g) {
        g.json["materials"] = {{{"alphaCutoff", "x"}}};
    });
    expectError("nodes must be an array", [](Gltf& g) { g.json["nodes"] = 1; });
    expectError("nodes[0] must be an object", [](Gltf& g) { g.json["nodes"] = {5}; });
    expectError("nodes[0].matrix must hold 16", [](Gltf& g) { g.json["nodes"][0]["matrix"] = {1, 2}; });
    expectError("beyond the range", [](Gltf& g) { g.json["nodes"][0]["translation"] = {1e300, 0, 0}; });
    expectError("component type 5124", [](Gltf& g) { g.json["accessors"][0]["componentType"] = 5124; });
    expectError("has the type \"VEC9\"", [](Gltf& g) { g.json["accessors"][0]["type"] = "VEC9"; });
    expectError("no unsigned integers", [](Gltf& g) { g.json["meshes"][0]["primitives"][0]["indices"] = 0; });
}

TEST(ImportGltfError, ExtensionsAndVersionsThatAreNotRead) {
    expectError("KHR_draco_mesh_compression",
                [](Gltf& g) { g.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; });
    expectError("glTF version \"1.0\"", [](Gltf& g) { g.json["asset"]["version"] = "1.0"; });
    expectError("asset", [](Gltf& g) { g.json.erase("asset"); });
}

TEST(ImportGltfError, NothingToRender) {
    expectError("nothing to render", [](Gltf& g) { g.json["nodes"] = {nlohmann::json::object()}; });
    expectError("nothing to render", [](Gltf& g) { g.json["scenes"][0]["nodes"] = nlohmann::json::array(); });
    expectError("\"only\"", [](Gltf& g) { g.json["nodes"] = {{{"mesh", 0}, {"name", "only"}, {"scale", {0, 0, 0}}}}; });
    expectError("do not exist: 1", [](Gltf& g) {
        g.json["meshes"][0]["primitives"][0]["indices"] = g.indices({100, 101, 102});
    });
}

TEST(ImportGltfError, BuffersThatAreMissingOrShort) {
    const ScratchFolder folder;
    const Gltf gltf = validGltf();
    const fs::path path = folder.write("scene.gltf", gltf.text());
    EXPECT_NE(errorOf(path).find("scene.bin: no such file"), std::string::npos) << errorOf(path);
    folder.write("scene.bin", "short");
    EXPECT_NE(errorOf(path).find("there are 5 (truncated?)"), std::string::npos) << errorOf(path);
}

/// Every truncation of a GLB, byte by byte, is an Error: no crash and no half-read scene.
TEST(ImportGltfError, TruncatedGlb) {
    const ScratchFolder folder;
    const std::string glb = validGltf().glb();
    EXPECT_EQ(errorOf(folder.write("whole.glb", glb)), "");
    for (size_t length = 0; length < glb.size(); ++length)
        ASSERT_NE(errorOf(folder.write("cut.glb", glb.substr(0, length))), "") << length;
    EXPECT_NE(errorOf(folder.write("cut.glb", glb.substr(0, 100))).find("truncated"), std::string::npos);
}

TEST(ImportGltfError, NotJson) {
    const ScratchFolder folder;
    EXPECT_NE(errorOf(folder.write("a.gltf", "{\"asset\": ")).find("not valid JSON"), std::string::npos);
    EXPECT_NE(errorOf(folder.write("b.gltf", "[]")).find("not a glTF document"), std::string::npos);
    EXPECT_NE(errorOf(folder.write("c.gltf", "")).find("not valid JSON"), std::string::npos);
    EXPECT_NE(errorOf(folder.write("d.gltf", std::string(200000, '['))).find("not valid JSON"), std::string::npos);
}

}  // namespace
}  // namespace raylab::importtest
