#include "import_support.h"

namespace raylab::importtest {
namespace {

using nlohmann::json;

/// A file of one quadric that node 0 shows, and nothing else.
Gltf quadricGltf(const json& surface) {
    Gltf gltf;
    gltf.json["extras"]["raylab"]["quadrics"] = {{{"name", "q"}, {"surfaces", json::array({surface})}}};
    gltf.json["nodes"] = {{{"name", "shown"}, {"extras", {{"raylab", {{"quadrics", 0}}}}}}};
    return gltf;
}

Quadric readOne(const json& surface) {
    const ScratchFolder folder;
    const Scene scene = importScene(quadricGltf(surface).write(folder));
    EXPECT_EQ(scene.meshes.size(), 1u);
    EXPECT_TRUE(scene.warnings.empty()) << joined(scene.warnings);
    return scene.meshes.at(0).quadrics.at(0);
}

TEST(ImportQuadrics, EveryKind) {
    const std::pair<const char*, QuadricKind> kinds[] = {{"ellipsoid", QuadricKind::ellipsoid},
                                                         {"cylinder", QuadricKind::cylinder},
                                                         {"cone", QuadricKind::cone},
                                                         {"hyperboloid", QuadricKind::hyperboloid},
                                                         {"paraboloid", QuadricKind::paraboloid}};
    for (const auto& [name, kind] : kinds)
        EXPECT_EQ(readOne({{"kind", name}, {"radii", {2, 0.5, 3}}, {"clip", {0.25, 1.5}}}),
                  (Quadric{kind, {2, 0.5f, 3}, 0.25f, 1.5f}))
            << name;
}

TEST(ImportQuadrics, WhatIsMissing) {
    EXPECT_EQ(readOne({{"kind", "ellipsoid"}}), (Quadric{QuadricKind::ellipsoid, glm::vec3(1), -1, 1}));
    EXPECT_EQ(readOne({{"kind", "ellipsoid"}, {"radii", {1, 2, 3}}}),
              (Quadric{QuadricKind::ellipsoid, {1, 2, 3}, -3, 3}));
    EXPECT_EQ(readOne({{"kind", "sphere"}, {"radius", 2.5}}),
              (Quadric{QuadricKind::ellipsoid, glm::vec3(2.5f), -2.5f, 2.5f}));
    EXPECT_EQ(readOne({{"kind", "cylinder"}, {"clip", {-1, 4}}}),
              (Quadric{QuadricKind::cylinder, glm::vec3(1), -1, 4}));
}

TEST(ImportQuadrics, NodesShareAnEntryAndPlaceIt) {
    const ScratchFolder folder;
    Gltf gltf = quadricGltf({{"kind", "sphere"}});
    const json shown = {{"raylab", {{"quadrics", 0}}}};
    gltf.json["scenes"] = {{{"nodes", {0, 1}}}};
    gltf.json["nodes"].push_back({{"translation", {10, 0, 0}}, {"scale", {2, 2, 2}}, {"children", {2}}});
    gltf.json["nodes"].push_back({{"name", "child"}, {"translation", {0, 1, 0}}, {"extras", shown}});
    const Scene scene = importScene(gltf.write(folder));
    ASSERT_EQ(scene.meshes.size(), 1u) << "stored once";
    EXPECT_EQ(scene.meshes[0].name, "q");
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(scene.instances[0].name, "shown");
    EXPECT_EQ(scene.instances[1].name, "child");
    EXPECT_EQ(scene.instances[1].objectToWorld * glm::vec4(1, 0, 0, 1), glm::vec4(12, 2, 0, 1));
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].name, "default");
}

TEST(ImportQuadrics, MaterialsAndMeshesBesideThem) {
    const ScratchFolder folder;
    Gltf gltf = quadricGltf({{"kind", "sphere"}});
    json triangle = gltf.trianglePrimitive();
    triangle["material"] = 2;
    gltf.mesh(triangle);
    gltf.json["materials"] = {{{"name", "nobody's"}}, {{"name", "quadric's"}}, {{"name", "triangle's"}}};
    gltf.json["nodes"][0]["mesh"] = 0;
    gltf.json["extras"]["raylab"]["quadrics"][0]["material"] = 1;
    gltf.json["extras"]["raylab"]["quadrics"].push_back(
        {{"name", "not shown"}, {"material", 0}, {"surfaces", {{{"kind", "sphere"}}}}});
    gltf.json["extras"]["raylab"]["sun"] = {{"elevation", 10}};
    const Scene scene = importScene(gltf.write(folder));
    ASSERT_EQ(scene.instances.size(), 2u);
    ASSERT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.meshes[scene.instances[0].mesh].triangles.size(), 1u);
    const Mesh& quadrics = scene.meshes[scene.instances[1].mesh];
    EXPECT_EQ(quadrics.quadrics.size(), 1u);
    ASSERT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.materials[quadrics.material].name, "quadric's");
    EXPECT_TRUE(scene.sky.has_value()) << "the extras of the file serve both";
}

TEST(ImportQuadrics, ATextureTransformThatCannotBeBakedIsSaid) {
    const ScratchFolder folder;
    Gltf gltf = quadricGltf({{"kind", "sphere"}});
    gltf.json["images"] = {{{"uri", "absent.png"}}};
    gltf.json["textures"] = {{{"source", 0}}};
    gltf.json["extras"]["raylab"]["quadrics"][0]["material"] = 0;
    json& texture = gltf.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}}}}}};
    EXPECT_TRUE(anyContains(importScene(gltf.write(folder)).warnings, "\"q\" ignore the KHR_texture_transform"));
}

TEST(ImportQuadrics, MistakesAreNamedWithTheirPlace) {
    const std::pair<json, const char*> cases[] = {
        {{{"radii", {1, 1, 1}}}, "surfaces[0] names no kind"},
        {{{"kind", 7}}, "surfaces[0].kind must be a string"},
        {{{"kind", "torus"}}, "there are sphere, ellipsoid, cylinder, cone, hyperboloid, paraboloid"},
        {{{"kind", "ellipsoid"}, {"radii", {1, 0, 1}}}, "positive radii"},
        {{{"kind", "ellipsoid"}, {"radii", {1, -2, 1}}}, "positive radii"},
        {{{"kind", "ellipsoid"}, {"radii", {1, 1, 1e20}}}, "positive radii"},
        {{{"kind", "ellipsoid"}, {"radii", {1, 1, 1e300}}}, "beyond the range of a float"},
        {{{"kind", "ellipsoid"}, {"radii", {1, 1}}}, "radii must hold 3 numbers"},
        {{{"kind", "ellipsoid"}, {"radii", {1, "a", 1}}}, "radii must be a number"},
        {{{"kind", "sphere"}, {"radius", 1e-30}}, "positive radii"},
        {{{"kind", "cylinder"}}, "needs \"clip\""},
        {{{"kind", "paraboloid"}}, "needs \"clip\""},
        {{{"kind", "cone"}, {"clip", {1, 1}}}, "lower clip plane below"},
        {{{"kind", "cone"}, {"clip", {2, 1}}}, "lower clip plane below"},
        {{{"kind", "cone"}, {"clip", {0, 1e19}}}, "beyond 1e18"},
        {{{"kind", "cone"}, {"clip", 3}}, "clip must be an array"},
        {{{"kind", "sphere"}, {"clip", {1, 2}}}, "leave nothing"},
        {{{"kind", "paraboloid"}, {"clip", {-2, 0}}}, "leave nothing"},
    };
    for (const auto& [surface, part] : cases) {
        const ScratchFolder folder;
        const std::string error = errorOf(quadricGltf(surface).write(folder));
        EXPECT_NE(error.find("scene.gltf: extras.raylab.quadrics[0]"), std::string::npos) << surface << ": " << error;
        EXPECT_NE(error.find(part), std::string::npos) << surface << ": " << error;
    }
}

TEST(ImportQuadrics, IndicesThatPointNowhere) {
    const ScratchFolder folder;
    Gltf gltf = quadricGltf({{"kind", "sphere"}});
    gltf.json["nodes"][0]["extras"]["raylab"]["quadrics"] = 1;
    EXPECT_NE(errorOf(gltf.write(folder)).find("nodes[0].extras.raylab.quadrics is 1"), std::string::npos);
    gltf = quadricGltf({{"kind", "sphere"}});
    gltf.json["extras"]["raylab"]["quadrics"][0]["material"] = 0;
    EXPECT_NE(errorOf(gltf.write(folder)).find("quadrics[0].material is 0"), std::string::npos);
    gltf = quadricGltf({{"kind", "sphere"}});
    gltf.json["extras"]["raylab"]["quadrics"][0]["surfaces"] = json::array();
    EXPECT_NE(errorOf(gltf.write(folder)).find("quadrics[0] needs at least one"), std::string::npos);
    gltf = quadricGltf({{"kind", "sphere"}});
    gltf.json["nodes"][0].erase("extras");
    EXPECT_NE(errorOf(gltf.write(folder)).find("nothing to render"), std::string::npos);
}

}  // namespace
}  // namespace raylab::importtest
