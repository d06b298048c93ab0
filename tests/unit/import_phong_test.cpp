#include "import_support.h"

namespace raylab::importtest {
namespace {

constexpr const char* kObj = "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::optional<PhongMaterial> ofMtl(const std::string& mtl) {
    const ScratchFolder folder;
    folder.write("a.mtl", "newmtl m\n" + mtl);
    return importScene(folder.write("a.obj", kObj)).materials.at(0).phong;
}

/// One quadric of a material with these extras.
Scene ofExtras(const std::string& phong) {
    const ScratchFolder folder;
    return importScene(folder.write("a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"extras": {"raylab": {"quadrics": 0}}}],
        "materials": [{"name": "m", "extras": {"raylab": {"phong": )" +
                                                  phong + R"(}}}],
        "extras": {"raylab": {"quadrics": [{"material": 0, "surfaces": [{"kind": "sphere"}]}]}}})"));
}

TEST(ImportPhong, MtlSaysItLiterally) {
    const auto phong = ofMtl("Kd 0.1 0.2 0.3\nKs 0.4 0.5 0.6\nNs 70\nNi 1.7\nillum 2\n");
    ASSERT_TRUE(phong);
    EXPECT_EQ(phong->diffuse, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(phong->specular, glm::vec3(0.4f, 0.5f, 0.6f));
    EXPECT_EQ(phong->exponent, 70.0f);
    EXPECT_EQ(phong->ior, 1.7f);
    EXPECT_EQ(phong->mirror, glm::vec3(0.0f));
    EXPECT_EQ(phong->tint, glm::vec3(0.0f));
}

TEST(ImportPhong, ExponentsStayWithinTheirBounds) {
    EXPECT_EQ(ofMtl("Kd 1 1 1\n")->exponent, 1.0f);
    EXPECT_EQ(ofMtl("Kd 1 1 1\nNs 1e9\n")->exponent, 10000.0f);
}

TEST(ImportPhong, MtlMirrorKeepsItsDiffusePart) {
    const auto phong = ofMtl("Kd 0.1 0.1 0.1\nKs 0.9 0.8 0.7\nillum 3\n");
    ASSERT_TRUE(phong);
    EXPECT_EQ(phong->diffuse, glm::vec3(0.1f));
    EXPECT_EQ(phong->mirror, glm::vec3(0.9f, 0.8f, 0.7f));
    EXPECT_EQ(phong->reflection, 1.0f);
    EXPECT_EQ(phong->ior, kOpaqueIor);
}

TEST(ImportPhong, MtlGlassScattersAtMostWhatItDoesNotLetThrough) {
    const auto phong = ofMtl("Kd 0.8 0.25 0.8\nTf 0.75 0.5 1\nNi 1.5\nillum 7\n");
    ASSERT_TRUE(phong);
    EXPECT_EQ(phong->tint, glm::vec3(0.75f, 0.5f, 1.0f));
    EXPECT_EQ(phong->diffuse, glm::vec3(0.25f, 0.25f, 0.0f));
    EXPECT_EQ(phong->mirror, glm::vec3(1.0f));
    EXPECT_NEAR(phong->reflection, 0.04f, 1e-6f);
}

TEST(ImportPhong, PhysicalMtlLeavesItToTheRoughness) { EXPECT_FALSE(ofMtl("Kd 1 1 1\nPr 0.3\nPm 0.7\n")); }

TEST(ImportPhong, ExtrasOfGltf) {
    const auto phong = ofExtras(R"({"diffuse": [0.5, 0.25, 1], "exponent": 12, "tint": [0, 0, 0.5], "ior": 1.25})")
                           .materials.at(0)
                           .phong;
    ASSERT_TRUE(phong);
    PhongMaterial expected;
    expected.diffuse = {0.5f, 0.25f, 1.0f};
    expected.exponent = 12.0f;
    expected.tint = {0.0f, 0.0f, 0.5f};
    expected.ior = 1.25f;
    EXPECT_EQ(*phong, expected);
}

TEST(ImportPhong, MistakesAreNamed) {
    const std::pair<const char*, const char*> mistakes[] = {{R"({"diffuse": [0.5, 2, 1]})", "diffuse"},
                                                            {R"({"mirror": [0.5, 0.5]})", "mirror"},
                                                            {R"({"exponent": 0})", "exponent"},
                                                            {R"({"reflection": -1})", "reflection"},
                                                            {R"({"ior": 0.5})", "ior"}};
    for (const auto& [json, key] : mistakes) {
        try {
            ofExtras(json);
            ADD_FAILURE() << json;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("materials[0].extras.raylab.phong"), std::string::npos)
                << error.what();
            EXPECT_NE(std::string(error.what()).find(key), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace raylab::importtest
