#include "assets/generate/materials.h"

#include <array>

#include "assets/generate/scene_tools.h"
#include "assets/generate/textures.h"
#include "engine/scene/f0_presets.h"

namespace raylab::assets {
namespace {

constexpr float kRadius = 0.42f;
constexpr float kSpacing = 1.02f;
constexpr float kStepDepth = 1.1f;
constexpr float kStepHeight = 0.42f;
constexpr size_t kBallsPerRow = 6;

using Row = std::array<Material, kBallsPerRow>;

/// Clear stuff that light passes through, tinted at each surface.
Material clear(std::string_view preset, glm::vec3 tint) {
    Material material = presetMaterial(findF0Preset(preset), 0.0f, tint);
    material.transmission = 1.0f;
    material.thin = false;
    return material;
}

Material metal(std::string_view preset, float roughness) { return presetMaterial(findF0Preset(preset), roughness); }

Material named(const char* name, Material material) {
    material.name = name;
    return material;
}

Row clearRow() {
    return {clear("water", {0.97f, 0.99f, 1.0f}),    clear("glass (low)", {0.90f, 1.0f, 0.94f}),
            glassMaterial("glass", glm::vec3(1.0f)), clear("glass (high)", {1.0f, 0.93f, 0.72f}),
            clear("ruby", {0.92f, 0.10f, 0.16f}),    clear("diamond", glm::vec3(1.0f))};
}

Row middleRow() {
    return {presetMaterial(findF0Preset("plastic"), 0.25f, {0.62f, 0.07f, 0.04f}),
            presetMaterial(findF0Preset("plastic (high)"), 0.04f, {0.02f, 0.17f, 0.24f}),
            named("plaster", plainMaterial("plaster", {0.82f, 0.79f, 0.74f}, 1.0f)),
            named("brushed aluminium", metal("aluminium", 0.35f)),
            named("rough copper", metal("copper", 0.45f)),
            named("rough gold", metal("gold", 0.3f))};
}

Row metalRow() {
    return {metal("iron", 0.12f),      named("cast iron", metal("iron", 0.6f)),
            metal("copper", 0.03f),    metal("gold", 0.03f),
            metal("aluminium", 0.02f), metal("silver", 0.0f)};
}

/// A lobe each that few materials have.
Row lobeRow() {
    Material lacquer = plainMaterial("lacquer", {0.45f, 0.02f, 0.03f}, 0.6f, 0.7f);
    lacquer.clearcoat = 1.0f;
    lacquer.clearcoatRoughness = 0.05f;
    Material velvet = plainMaterial("velvet", {0.05f, 0.03f, 0.16f}, 1.0f);
    velvet.sheenColor = {0.70f, 0.55f, 0.95f};
    velvet.sheenRoughness = 0.4f;
    Material turned = named("turned steel", metal("iron", 0.25f));
    turned.anisotropy = 0.85f;
    Material pearl = plainMaterial("pearl", {0.80f, 0.76f, 0.70f}, 0.3f);
    pearl.ior = 2.0f;
    pearl.specularColor = {1.0f, 0.45f, 0.75f};
    Material frosted = glassMaterial("frosted glass", glm::vec3(1.0f));
    frosted.roughness = 0.4f;
    Material amber = glassMaterial("amber", glm::vec3(1.0f));
    amber.attenuationColor = {0.90f, 0.42f, 0.06f};
    amber.attenuationDistance = 0.4f;
    return {lacquer, velvet, turned, pearl, frosted, amber};
}

/// Balls of a row from left to right; row 0 is the lowest and nearest.
void addRow(Scene& scene, const Row& row, size_t index) {
    const float depth = -kStepDepth * static_cast<float>(index);
    const float top = kStepHeight * static_cast<float>(index);
    for (size_t i = 0; i < row.size(); ++i) {
        Mesh ball{.name = row[i].name + " ball", .material = addMaterial(scene, row[i])};
        ball.quadrics = {{QuadricKind::ellipsoid, glm::vec3(kRadius), -kRadius, kRadius}};
        scene.meshes.push_back(std::move(ball));
        const float x = kSpacing * (static_cast<float>(i) - 0.5f * static_cast<float>(row.size() - 1));
        addInstance(scene, row[i].name + " ball", static_cast<uint32_t>(scene.meshes.size() - 1),
                    place({x, top + kRadius, depth}));
    }
}

void addStage(Scene& scene) {
    const uint32_t wood = addMaterial(scene, texturedMaterial(scene, "wood", paintWood(), 0.5f));
    const uint32_t paper = addMaterial(scene, plainMaterial("backdrop", {0.34f, 0.36f, 0.39f}, 1.0f));
    constexpr float kHalf = 3.4f;
    for (int i = 0; i < 4; ++i) {
        const auto step = static_cast<float>(i);
        const float front = 0.5f * kStepDepth - kStepDepth * step;
        Geometry slab =
            box({-kHalf, kStepHeight * (step - 1.0f), front - kStepDepth}, {kHalf, kStepHeight * step, front});
        scaleUvs(slab, glm::vec2(1.0f / kWoodMetres));
        addInstance(scene, "step", addMesh(scene, "step", slab, wood));
    }
    // Paper that runs from the floor up the wall in one bend.
    const float floor = -kStepHeight;
    const Profile paperProfile = {line({12.0f, floor}, {-3.4f, floor}),
                                  profileArc({-3.4f, floor + 1.6f}, 1.6f, -90.0f, -180.0f, 24),
                                  line({-5.0f, floor + 1.6f}, {-5.0f, 9.0f})};
    addInstance(scene, "paper", addMesh(scene, "paper", sweepAlongX(paperProfile, 30.0f), paper));
}

void addGlowingSheet(Scene& scene, const char* name, const std::array<glm::vec3, 4>& corners, glm::vec3 radiance) {
    Geometry sheet;
    appendQuad(sheet, corners[0], corners[1], corners[2], corners[3], {0.0f, 1.0f}, {1.0f, 0.0f});
    Material lit = plainMaterial(name, glm::vec3(0.8f), 1.0f);
    lit.emission = radiance;
    addInstance(scene, name, addMesh(scene, name, sheet, addMaterial(scene, lit)));
}

struct SoftBox {
    const char* name;
    glm::vec3 centre;
    glm::vec2 half;
    glm::vec3 radiance;
    glm::vec3 intensity;  ///< of the spot light
};

/// A lit rectangle that faces the balls, and a spot light in front of it.
void addSoftBox(Scene& scene, const SoftBox& softBox) {
    constexpr glm::vec3 kAim(0.0f, 0.5f, -1.0f);
    const glm::vec3 towards = glm::normalize(kAim - softBox.centre);
    const glm::vec3 right = softBox.half.x * glm::normalize(glm::cross(glm::vec3(0.0f, 1.0f, 0.0f), towards));
    const glm::vec3 up = softBox.half.y * glm::normalize(glm::cross(towards, right));
    const glm::vec3 c = softBox.centre;
    addGlowingSheet(scene, softBox.name, {c - right - up, c + right - up, c + right + up, c - right + up},
                    softBox.radiance);
    scene.lights.push_back({.name = std::string(softBox.name) + " spot",
                            .kind = LightKind::spot,
                            .position = c + 0.05f * towards,
                            .direction = towards,
                            .intensity = softBox.intensity,
                            .innerConeRadians = glm::radians(50.0f),
                            .outerConeRadians = glm::radians(85.0f)});
}

/// What the balls mirror beside the soft boxes: a pale ceiling and a dim wall behind the camera.
void addStudio(Scene& scene) {
    addGlowingSheet(scene, "ceiling", {{{-10, 7.5f, -5}, {10, 7.5f, -5}, {10, 7.5f, 12}, {-10, 7.5f, 12}}},
                    {0.50f, 0.54f, 0.60f});
    addGlowingSheet(scene, "wall", {{{10, -0.4f, 12}, {-10, -0.4f, 12}, {-10, 7.5f, 12}, {10, 7.5f, 12}}},
                    {0.16f, 0.145f, 0.13f});
}

}  // namespace

Scene makeMaterials() {
    Scene scene;
    scene.name = "Materials";
    addStage(scene);
    addStudio(scene);
    addRow(scene, clearRow(), 0);
    addRow(scene, middleRow(), 1);
    addRow(scene, metalRow(), 2);
    addRow(scene, lobeRow(), 3);
    addSoftBox(scene, {"key", {-4.2f, 4.6f, 3.2f}, {1.3f, 0.9f}, {9.0f, 8.4f, 7.4f}, {52.0f, 47.0f, 40.0f}});
    addSoftBox(scene, {"fill", {4.6f, 3.2f, 3.4f}, {0.7f, 1.4f}, {3.6f, 4.2f, 5.2f}, {18.0f, 21.0f, 26.0f}});
    addSoftBox(scene, {"top", {0.6f, 5.8f, -2.2f}, {2.2f, 0.5f}, {6.0f, 6.0f, 6.0f}, {22.0f, 22.0f, 22.0f}});
    addCamera(scene, "balls", {0.0f, 3.4f, 8.2f}, {0.0f, 0.78f, -1.1f}, glm::radians(29.0f));
    return scene;
}

}  // namespace raylab::assets
