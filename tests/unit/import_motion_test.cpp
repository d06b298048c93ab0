#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/bounds.h"
#include "engine/scene/instance_motion.h"
#include "engine/scene/needs.h"
#include "import_support.h"

/// Instances that move while the shutter is open.
namespace raylab::importtest {
namespace {

/// Node 0, which the test moves, above node 1, which shows a triangle one unit along x.
Gltf gltfOfTwoNodes() {
    Gltf gltf;
    gltf.mesh(gltf.trianglePrimitive());
    gltf.json["nodes"] = {{{"children", {1}}}, {{"mesh", 0}, {"translation", {1, 0, 0}}}};
    return gltf;
}

void addChannel(Gltf& gltf, const char* path, const char* interpolation, const std::vector<float>& times,
                const std::vector<float>& values) {
    const bool isRotation = std::string(path) == "rotation";
    const size_t input = gltf.accessor(times, 5126, "SCALAR", times.size());
    const size_t output =
        gltf.accessor(values, 5126, isRotation ? "VEC4" : "VEC3", values.size() / (isRotation ? 4 : 3));
    if (!gltf.json.contains("animations"))
        gltf.json["animations"] = {{{"samplers", nlohmann::json::array()}, {"channels", nlohmann::json::array()}}};
    nlohmann::json& animation = gltf.json["animations"][0];
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", 0}, {"path", path}}}});
}

void setShutter(Gltf& gltf, double open, double close) { gltf.json["extras"]["raylab"]["shutter"] = {open, close}; }

glm::vec3 origin(const glm::mat4& matrix) { return glm::vec3(matrix[3]); }

const Instance& onlyInstance(const Scene& scene) {
    EXPECT_EQ(scene.instances.size(), 1u);
    return scene.instances.at(0);
}

/// A quarter turn about y in two seconds: after a third and two thirds of them 30 and 60 degrees.
TEST(ImportMotion, LinearRotationsTurnAtEvenSpeed) {
    const ScratchFolder folder;
    Gltf gltf = gltfOfTwoNodes();
    const float h = std::sqrt(0.5f);
    addChannel(gltf, "rotation", "LINEAR", {1, 3}, {0, 0, 0, 1, 0, h, 0, h});
    setShutter(gltf, 1.0 + 2.0 / 3.0, 1.0 + 4.0 / 3.0);
    const Scene scene = importScene(gltf.write(folder));
    const Instance& instance = onlyInstance(scene);
    ASSERT_TRUE(moves(instance));
    const float c = std::sqrt(0.75f);
    expectNear(origin(instance.objectToWorld), {c, 0.0f, -0.5f});
    expectNear(origin(*instance.endToWorld), {0.5f, 0.0f, -c});
    EXPECT_NE(analyseNeeds(scene).mask & shared::kNeedMotion, 0u);
    EXPECT_NE(analyseNeeds(scene).mask & shared::kNeedInstancing, 0u) << "what moves has a tree of its own";
}

/// Hermite's cubic with tangents 6 and 0 from 0 to 1 in half a second: at half the way 1/2 + 6 x .5 / 8. Then the last
/// key holds. Steps hold the key before.
TEST(ImportMotion, CubicSplinesAndSteps) {
    const ScratchFolder folder;
    Gltf gltf = gltfOfTwoNodes();
    addChannel(gltf, "translation", "CUBICSPLINE", {0, 0.5f}, {0, 0, 0, 0, 0, 0, 0, 6, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0});
    addChannel(gltf, "scale", "STEP", {0, 0.5f}, {2, 2, 2, 3, 3, 3});
    setShutter(gltf, 0.25, 9.0);
    const Scene scene = importScene(gltf.write(folder));
    const Instance& instance = onlyInstance(scene);
    ASSERT_TRUE(moves(instance));
    expectNear(origin(instance.objectToWorld), {2.0f, 0.875f, 0.0f});
    expectNear(origin(*instance.endToWorld), {3.0f, 1.0f, 0.0f});
}

TEST(ImportMotion, WithoutAShutterTheAnimationIsLeftOut) {
    const ScratchFolder folder;
    Gltf gltf = gltfOfTwoNodes();
    addChannel(gltf, "translation", "LINEAR", {0, 1}, {5, 0, 0, 9, 0, 0});
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_FALSE(moves(onlyInstance(scene)));
    expectNear(origin(scene.instances[0].objectToWorld), {1.0f, 0.0f, 0.0f});
    EXPECT_EQ(analyseNeeds(scene).mask & shared::kNeedMotion, 0u);
}

/// The end of a parent's motion moves its children, and the bounds hold both ends.
TEST(ImportMotion, EndMatrixOfExtras) {
    const ScratchFolder folder;
    Gltf gltf = gltfOfTwoNodes();
    gltf.json["nodes"][0]["extras"]["raylab"]["endMatrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 7, 0, 1};
    const Scene scene = importScene(gltf.write(folder));
    ASSERT_TRUE(moves(onlyInstance(scene)));
    expectNear(origin(scene.instances[0].objectToWorld), {1.0f, 0.0f, 0.0f});
    expectNear(origin(*scene.instances[0].endToWorld), {1.0f, 7.0f, 0.0f});
    expectNear(sceneBounds(scene).lo, {1.0f, 0.0f, 0.0f});
    expectNear(sceneBounds(scene).hi, {2.0f, 8.0f, 0.0f});
}

/// Halfway between a matrix and its half turn everything lies on the axis.
TEST(ImportMotion, AHalfTurnIsRefusedWithAWarning) {
    const ScratchFolder folder;
    Gltf gltf = gltfOfTwoNodes();
    gltf.json["nodes"][0]["extras"]["raylab"]["endMatrix"] = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1};
    const Scene scene = importScene(gltf.write(folder));
    EXPECT_FALSE(moves(onlyInstance(scene)));
    EXPECT_TRUE(anyContains(scene.warnings, "stands still")) << joined(scene.warnings);
}

TEST(ImportMotion, MistakesNameTheirPlace) {
    const ScratchFolder folder;
    Gltf backwards = gltfOfTwoNodes();
    setShutter(backwards, 1.0, 0.5);
    EXPECT_NE(errorOf(backwards.write(folder)).find("shutter"), std::string::npos);
    Gltf keys = gltfOfTwoNodes();
    addChannel(keys, "translation", "LINEAR", {0, 1}, {1, 2, 3});
    setShutter(keys, 0.0, 0.5);
    EXPECT_NE(errorOf(keys.write(folder)).find("animations[0]"), std::string::npos);
}

}  // namespace
}  // namespace raylab::importtest
