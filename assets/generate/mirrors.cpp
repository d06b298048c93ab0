#include "assets/generate/mirrors.h"

#include "assets/generate/architecture.h"
#include "assets/generate/scene_tools.h"
#include "assets/generate/textures.h"

namespace raylab::assets {
namespace {

constexpr float kMirrorDistance = 2.6f;  ///< from the statue
constexpr glm::vec2 kMirrorHalf(2.3f, 2.45f);
constexpr float kMirrorFoot = 0.3f;
constexpr float kPedestal = 0.9f;
constexpr float kRound = 7.2f;  ///< radius of the ring of columns
constexpr int kColumns = 24;

struct Materials {
    uint32_t marble;
    uint32_t limestone;
    uint32_t paving;
    uint32_t mirror;
    uint32_t gold;
    uint32_t lawn;
};

Materials addMaterials(Scene& scene) {
    Materials m{};
    m.marble = addMaterial(scene, texturedMaterial(scene, "marble", paintMarble(), 0.38f));
    m.limestone = addMaterial(scene, texturedMaterial(scene, "limestone", paintLimestone(), 0.85f));
    m.paving = addMaterial(scene, texturedMaterial(scene, "paving", paintPaving(), 1.0f));
    m.mirror = addMaterial(scene, plainMaterial("mirror", glm::vec3(0.9f), 0.0f, 1.0f));
    m.gold = addMaterial(scene, plainMaterial("gold", {1.0f, 0.71f, 0.29f}, 0.3f, 1.0f));
    m.lawn = addMaterial(scene, plainMaterial("lawn", {0.10f, 0.14f, 0.04f}, 1.0f));
    return m;
}

/// Stands on y = 0 and faces +Z: the glass, and a moulded frame about it.
void addMirror(Scene& scene, const Materials& m) {
    const glm::vec2 h = kMirrorHalf;
    Geometry glass;
    appendQuad(glass, {-h.x, -h.y, 0.0f}, {h.x, -h.y, 0.0f}, {h.x, h.y, 0.0f}, {-h.x, h.y, 0.0f}, {0.0f, 1.0f},
               {1.0f, 0.0f});
    // The lathe turns about +Y: laid on its back, its heights stand out of the glass.
    const Profile moulding = {line({0.24f, -0.12f}, {0.24f, 0.02f}),
                              profileArc({0.17f, 0.02f}, 0.07f, 0.0f, 180.0f, 12), line({0.10f, 0.02f}, {0.08f, 0.05f}),
                              profileArc({0.04f, 0.05f}, 0.04f, 0.0f, 180.0f, 10), line({0.0f, 0.05f}, {0.0f, -0.02f})};
    const glm::mat4 onItsBack(glm::vec4(1, 0, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, -1, 0, 0),
                              glm::vec4(0, 0, 0, 1));
    Geometry frame;
    append(frame, rectangularLathe(moulding, h), onItsBack);
    const uint32_t glassMesh = addMesh(scene, "mirror", glass, m.mirror);
    const uint32_t frameMesh = addMesh(scene, "frame", frame, m.gold);
    for (const float side : {-1.0f, 1.0f}) {
        const glm::mat4 pose = place({side * kMirrorDistance, kMirrorFoot + h.y, 0.0f}, -90.0f * side);
        addInstance(scene, "mirror glass", glassMesh, pose);
        addInstance(scene, "mirror frame", frameMesh, pose);
    }
}

void addStone(Scene& scene, const char* name, Geometry g, uint32_t material, float metres, const glm::mat4& pose) {
    scaleUvs(g, glm::vec2(1.0f / metres));
    addInstance(scene, name, addMesh(scene, name, g, material), pose);
}

void addRound(Scene& scene, const Materials& m) {
    Geometry floor = lathe({line({13.0f, 0.0f}, {0.0f, 0.0f})}, 96);
    projectUvs(floor, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f});
    addStone(scene, "floor", floor, m.paving, kPavingMetres, glm::mat4(1.0f));
    const Geometry lawn = lathe({line({400.0f, 0.0f}, {13.0f, 0.0f})}, 96);
    addStone(scene, "lawn", lawn, m.lawn, 1.0f, glm::mat4(1.0f));
    const float low = kSpringing, r = kRound;
    const Profile entablature = {line({r - 0.26f, low + 0.62f}, {r - 0.26f, low}),
                                 line({r - 0.26f, low}, {r + 0.26f, low}),
                                 line({r + 0.26f, low}, {r + 0.26f, low + 0.40f}),
                                 profileArc({r + 0.26f, low + 0.51f}, 0.11f, -90.0f, 0.0f, 8),
                                 line({r + 0.37f, low + 0.51f}, {r + 0.37f, low + 0.62f}),
                                 line({r + 0.37f, low + 0.62f}, {r - 0.26f, low + 0.62f})};
    addStone(scene, "entablature", lathe(entablature, 192), m.limestone, kLimestoneMetres, glm::mat4(1.0f));
    Geometry shaft = column();
    scaleUvs(shaft, glm::vec2(1.0f / kLimestoneMetres));
    const uint32_t columnMesh = addMesh(scene, "column", shaft, m.limestone);
    for (int i = 0; i < kColumns; ++i) {
        const float degrees = 360.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(kColumns);
        addInstance(scene, "column", columnMesh, place(glm::vec3(0.0f), degrees) * place({0.0f, 0.0f, kRound}));
    }
}

}  // namespace

Scene makeMirrors(const Geometry& statue) {
    Scene scene;
    scene.name = "Mirrors";
    scene.sky = SkyDescription{.sunElevationRadians = glm::radians(16.0f),
                               .sunAzimuthRadians = glm::radians(205.0f),
                               .turbidity = 3.0f,
                               .scale = 0.5f};
    const Materials m = addMaterials(scene);
    addRound(scene, m);
    addMirror(scene, m);
    addStone(scene, "pedestal", pedestal(kPedestal, 0.52f), m.limestone, kLimestoneMetres, glm::mat4(1.0f));
    addStone(scene, "victory", statue, m.marble, kMarbleMetres, place({0.0f, kPedestal, 0.0f}, 15.0f));
    scene.lights.push_back({.name = "lamp", .position = {0.9f, 6.2f, 4.2f}, .intensity = {190.0f, 172.0f, 145.0f}});
    addCamera(scene, "statue", {0.7f, 2.0f, 6.75f}, {0.0f, 2.5f, 0.0f}, glm::radians(47.0f));
    addCamera(scene, "between", {-2.2f, 2.6f, 2.15f}, {2.6f, 2.45f, -0.55f}, glm::radians(58.0f));
    addCamera(scene, "corridor", {2.45f, 3.1f, 1.35f}, {-2.6f, 2.5f, 0.15f}, glm::radians(52.0f));
    return scene;
}

}  // namespace raylab::assets
