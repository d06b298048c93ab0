#include "assets/generate/quadrics.h"

#include <glm/gtc/matrix_transform.hpp>

#include "assets/generate/scene_tools.h"
#include "assets/generate/textures.h"

namespace raylab::assets {
namespace {

constexpr glm::vec3 kTableHalf(2.2f, 0.06f, 1.35f);
constexpr float kFloor = -0.85f;
constexpr float kWall = -3.2f;

/// Stands a quadric's z axis upright: its origin at `foot`.
glm::mat4 upright(glm::vec3 foot) {
    return glm::rotate(glm::translate(glm::mat4(1.0f), foot), glm::radians(-90.0f), glm::vec3(1.0f, 0.0f, 0.0f));
}

uint32_t addQuadric(Scene& scene, const std::string& name, const Quadric& quadric, const Material& material,
                    const glm::mat4& pose) {
    Mesh mesh{.name = name, .material = addMaterial(scene, material)};
    mesh.quadrics = {quadric};
    scene.meshes.push_back(std::move(mesh));
    const auto index = static_cast<uint32_t>(scene.meshes.size() - 1);
    addInstance(scene, name, index, pose);
    return index;
}

void addSolid(Scene& scene, const std::string& name, Geometry g, uint32_t material, float metres) {
    scaleUvs(g, glm::vec2(1.0f / metres));
    addInstance(scene, name, addMesh(scene, name, g, material));
}

void addRoom(Scene& scene) {
    const uint32_t wood = addMaterial(scene, texturedMaterial(scene, "wood", paintWood(), 0.6f));
    const uint32_t tiles =
        addMaterial(scene, texturedMaterial(scene, "terracotta floor", paintTerracottaFloor(), 1.0f));
    const uint32_t plaster = addMaterial(scene, texturedMaterial(scene, "plaster", paintPlaster(), 0.95f));
    const float under = -2.0f * kTableHalf.y;
    addSolid(scene, "table top", box({-kTableHalf.x, under, -kTableHalf.z}, {kTableHalf.x, 0.0f, kTableHalf.z}), wood,
             kWoodMetres);
    for (const float x : {-1.7f, 1.7f})
        addSolid(scene, "trestle", box({x - 0.08f, kFloor, -1.1f}, {x + 0.08f, under, 1.1f}), wood, kWoodMetres);
    addSolid(scene, "floor", box({-9.0f, kFloor - 0.1f, kWall - 0.3f}, {9.0f, kFloor, 9.0f}), tiles, kTerracottaMetres);
    addSolid(scene, "wall", box({-9.0f, kFloor, kWall - 0.3f}, {9.0f, 2.4f, kWall}), plaster, kPlasterMetres);
}

/// From left to right. Where a surface is cut below its origin, the pose lifts the cut onto the table.
void addBackRow(Scene& scene) {
    addQuadric(scene, "vase", {QuadricKind::hyperboloid, {0.26f, 0.26f, 0.42f}, -0.6f, 0.6f},
               plainMaterial("glazed blue", {0.03f, 0.10f, 0.28f}, 0.25f), upright({-1.45f, 0.6f, -0.55f}));
    addQuadric(scene, "silver ball", {QuadricKind::ellipsoid, glm::vec3(0.5f), -0.5f, 0.5f},
               plainMaterial("silver", {0.95f, 0.93f, 0.88f}, 0.0f, 1.0f), upright({-0.35f, 0.5f, -0.6f}));
    addQuadric(scene, "marble drum", {QuadricKind::cylinder, {0.34f, 0.34f, 1.0f}, 0.0f, 0.95f},
               texturedMaterial(scene, "marble", paintMarble(), 0.38f), upright({0.7f, 0.0f, -0.6f}));
    addQuadric(scene, "copper waist", {QuadricKind::hyperboloid, {0.20f, 0.32f, 0.5f}, -0.5f, 0.25f},
               plainMaterial("copper", {0.95f, 0.64f, 0.54f}, 0.12f, 1.0f), upright({1.55f, 0.5f, -0.55f}));
}

void addFrontRow(Scene& scene) {
    addQuadric(scene, "cut egg", {QuadricKind::ellipsoid, {0.5f, 0.34f, 0.3f}, -0.3f, 0.14f},
               plainMaterial("terracotta", {0.52f, 0.215f, 0.115f}, 0.6f), upright({-1.2f, 0.3f, 0.45f}));
    addQuadric(scene, "glass ball", {QuadricKind::ellipsoid, glm::vec3(0.3f), -0.3f, 0.3f},
               glassMaterial("clear glass", {0.99f, 1.0f, 0.995f}), upright({-0.35f, 0.3f, 0.55f}));
    const uint32_t bowl =
        addQuadric(scene, "bowl", {QuadricKind::paraboloid, {0.36f, 0.36f, 0.42f}, 0.0f, 0.5f},
                   plainMaterial("white glaze", {0.80f, 0.78f, 0.72f}, 0.15f), upright({0.45f, 0.0f, 0.45f}));
    addInstance(scene, "small bowl", bowl, glm::scale(upright({0.05f, 0.0f, 1.02f}), glm::vec3(0.45f)));
    addQuadric(scene, "open cone", {QuadricKind::cone, {0.3f, 0.3f, 0.7f}, -0.7f, -0.12f},
               plainMaterial("orange", {0.85f, 0.27f, 0.02f}, 0.45f), upright({1.2f, 0.7f, 0.5f}));
    // Lying on its side: its axis is that of the picture's depth.
    addQuadric(scene, "ring", {QuadricKind::cylinder, {0.2f, 0.2f, 1.0f}, -0.08f, 0.08f},
               plainMaterial("gold", {1.0f, 0.71f, 0.29f}, 0.16f, 1.0f),
               glm::rotate(glm::translate(glm::mat4(1.0f), {-0.85f, 0.2f, 0.95f}), glm::radians(35.0f),
                           glm::vec3(0.0f, 1.0f, 0.0f)));
}

}  // namespace

Scene makeQuadrics() {
    Scene scene;
    scene.name = "Quadrics";
    scene.sky = SkyDescription{.sunElevationRadians = glm::radians(42.0f), .sunAzimuthRadians = glm::radians(215.0f)};
    addRoom(scene);
    addBackRow(scene);
    addFrontRow(scene);
    addCamera(scene, "table", {0.15f, 1.75f, 4.1f}, {0.0f, 0.3f, 0.0f}, glm::radians(34.0f));
    return scene;
}

}  // namespace raylab::assets
