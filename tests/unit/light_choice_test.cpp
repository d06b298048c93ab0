#include <gtest/gtest.h>

#include "engine/render/gpu_data.h"
#include "tests/support/scene_build.h"

/// Where `auto` takes a tree over the lights.
namespace raylab::support {
namespace {

bool takesTree(const Scene& scene) {
    MaterialTables materials = packMaterials(scene);
    return !packLights(scene, 10.0f, materials).nodes.empty();
}

void addLight(Scene& scene, LightKind kind, const glm::vec3& position) {
    Light light;
    light.kind = kind;
    light.position = position;
    light.intensity = glm::vec3(1.0f);
    scene.lights.push_back(light);
}

/// A unit square in side x side x 2 triangles, at a height.
Mesh tiledLamp(Scene& scene, int side, float height) {
    Mesh mesh;
    mesh.material = addMaterial(scene, lamp(1.0f));
    for (int i = 0; i < side * side; ++i) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        const float x = static_cast<float>(i % side), z = static_cast<float>(i / side), n = static_cast<float>(side);
        for (const auto& [dx, dz] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}})
            mesh.positions.emplace_back((x + dx) / n, height, (z + dz) / n);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangles.emplace_back(first, first + 2, first + 3);
    }
    return mesh;
}

TEST(LightChoice, AutoIsATreeFromTwoPointsOn) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.5f)), 3.0f));
    addLight(scene, LightKind::point, {0.0f, 1.0f, 0.0f});
    EXPECT_FALSE(takesTree(scene));
    addLight(scene, LightKind::directional, {});
    addLight(scene, LightKind::directional, {});
    EXPECT_FALSE(takesTree(scene)) << "suns are nowhere";
    addLight(scene, LightKind::spot, {1.0f, 1.0f, 0.0f});
    EXPECT_TRUE(takesTree(scene));
}

TEST(LightChoice, AutoTakesOneLampForOneHoweverManyTrianglesItHas) {
    Scene one;
    addMesh(one, tiledLamp(one, 16, 1.0f));
    EXPECT_FALSE(takesTree(one));
    Scene two = one;
    addMesh(two, tiledLamp(two, 16, 5.0f));
    EXPECT_TRUE(takesTree(two)) << "four units apart";
    Scene few;
    addMesh(few, tiledLamp(few, 2, 1.0f));
    addMesh(few, tiledLamp(few, 2, 5.0f));
    EXPECT_FALSE(takesTree(few)) << "16 triangles";
}

}  // namespace
}  // namespace raylab::support
