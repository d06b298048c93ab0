#include "assets/generate/courtyard.h"

#include "assets/generate/architecture.h"
#include "assets/generate/building.h"
#include "assets/generate/landscape.h"
#include "assets/generate/noise.h"
#include "assets/generate/ornaments.h"
#include "assets/generate/plants.h"

namespace raylab::assets {
namespace {

constexpr glm::vec2 kPool(1.95f, 5.5f);
constexpr glm::vec3 kPoolCentre(0.0f, 0.0f, 0.7f);
constexpr glm::vec3 kStatueFoot(0.0f, 1.5f, -3.2f);

/// Assimp finds a camera's node by name: no other node may bear a camera's name, so the statue's is "victory".
void addPool(Builder& b, const Geometry& statue) {
    b.put("pool curb", b.stone("pool curb", poolCurb(kPool)), place(kPoolCentre));
    Geometry water;
    appendQuad(water, {-kPool.x, 0.0f, kPool.y}, {kPool.x, 0.0f, kPool.y}, {kPool.x, 0.0f, -kPool.y},
               {-kPool.x, 0.0f, -kPool.y}, {-kPool.x, kPool.y}, {kPool.x, -kPool.y});
    b.put("water", b.mesh("water", water, b.palette().water, kWaterMetres),
          place(kPoolCentre + glm::vec3(0.0f, kPoolRim - 0.07f, 0.0f)));
    b.put("pedestal", b.stone("pedestal", pedestal(kStatueFoot.y, 0.52f)), place({kStatueFoot.x, 0.0f, kStatueFoot.z}));
    b.put("victory", b.mesh("victory", statue, b.palette().marble, kMarbleMetres), place(kStatueFoot, 24.0f));
}

void addPlants(Builder& b) {
    const Palette& p = b.palette();
    const uint32_t pot = b.mesh("plant pot", plantPot(), p.terracotta);
    const uint32_t earth = b.mesh("pot earth", potEarth(), p.earth);
    const Plant citrus = citrusTree(501);
    const uint32_t trunk = b.mesh("citrus trunk", citrus.wood, p.bark);
    const uint32_t leaves = b.mesh("citrus leaves", citrus.leaves, p.citrusLeaf);
    const uint32_t fruit = b.mesh("oranges", citrus.fruit, p.orange);
    const glm::vec3 places[] = {{-3.1f, 0.0f, 5.6f}, {-3.1f, 0.0f, 0.7f}, {-3.1f, 0.0f, -4.2f}, {3.1f, 0.0f, -5.4f}};
    Dice dice(503);
    for (const glm::vec3& at : places) {
        const glm::mat4 standing = place(at, dice.roll(0.0f, 360.0f));
        const glm::mat4 growing = standing * place({0.0f, 0.55f, 0.0f}, 0.0f, glm::vec3(dice.roll(0.92f, 1.08f)));
        b.put("plant pot", pot, standing);
        b.put("pot earth", earth, standing);
        b.put("citrus trunk", trunk, growing);
        b.put("citrus leaves", leaves, growing);
        b.put("oranges", fruit, growing);
    }
    const Plant vine = climber(505);
    const uint32_t vineWood = b.mesh("vine wood", vine.wood, p.bark);
    const uint32_t vineLeaves = b.mesh("bougainvillea", vine.leaves, p.bougainvillea);
    const glm::mat4 vines[] = {place({-kCourtHalfX, kGalleryFloor, 2.5f}, 90.0f),
                               place({1.5f * kBay, kGalleryFloor, -kCourtHalfZ}, 0.0f, {-1.0f, 1.0f, 1.0f}),
                               place({kCourtHalfX, kGalleryFloor, 2.5f}, -90.0f)};
    for (const glm::mat4& pose : vines) {
        b.put("vine wood", vineWood, pose);
        b.put("bougainvillea", vineLeaves, pose);
    }
}

void addLandscape(Builder& b) {
    const Palette& p = b.palette();
    b.putOnce("hills", b.mesh("hills", hills(), p.hills));
    const Plant tree = cypress(511);
    const uint32_t trunk = b.mesh("cypress trunk", tree.wood, p.bark);
    const uint32_t leaves = b.mesh("cypress leaves", tree.leaves, p.cypressLeaf);
    const glm::vec4 places[] = {{11.5f, -0.5f, -15.0f, 9.5f},  {14.0f, -0.8f, -11.5f, 8.0f},
                                {10.5f, -0.4f, -3.0f, 7.0f},   {12.0f, -0.5f, 1.5f, 8.5f},
                                {4.0f, -0.2f, -17.5f, 11.0f},  {1.2f, -0.2f, -18.5f, 9.0f},
                                {-15.0f, -0.5f, -4.0f, 10.0f}, {17.0f, -1.2f, -22.0f, 10.0f}};
    Dice dice(513);
    for (const glm::vec4& at : places) {
        const glm::mat4 pose = place(glm::vec3(at), dice.roll(0.0f, 360.0f), {1.1f * at.w, at.w, 1.1f * at.w});
        b.put("cypress trunk", trunk, pose);
        b.put("cypress leaves", leaves, pose);
    }
}

/// A bell tower behind the far corner; its belfry is made of the court's arches.
void addTower(Builder& b, uint32_t archWallMesh, uint32_t archStonesMesh, uint32_t pierMesh) {
    const glm::vec3 foot(-9.8f, 0.0f, -16.0f);
    b.put("tower walls", b.mesh("tower walls", towerWalls(), b.palette().plaster, kPlasterMetres), place(foot));
    b.put("tower roof", b.mesh("tower roof", towerRoof(), b.palette().roofTile, kRoofMetres), place(foot));
    for (const float yaw : {0.0f, 90.0f, 180.0f, 270.0f}) {
        const glm::mat4 face = place(foot, yaw) * place({0.0f, kBelfryFloor, 0.5f * kBay});
        b.put("arch wall", archWallMesh, face);
        b.put("arch stones", archStonesMesh, face);
        b.put("pier", pierMesh, face * place({0.5f * kBay, 0.0f, 0.0f}));
    }
}

void addStillLife(Builder& b) {
    const Palette& p = b.palette();
    const glm::mat4 table = place({3.95f, 0.0f, 5.95f}, -6.0f);
    const auto onTable = [&](float x, float z, float yawDegrees = 0.0f) {
        return table * place({x, kTableHeight, z}, yawDegrees);
    };
    constexpr float kBall = 0.15f;
    constexpr float kSmallBall = 0.10f;
    const float lift = 0.012f + std::sqrt(0.75f);
    b.put("stone table", b.stone("stone table", stoneTable()), table);
    b.put("armillary", b.mesh("armillary", armillary(), p.gold), onTable(-0.50f, -0.06f, 30.0f));
    b.put("glass ball", b.mesh("glass ball", sphere(kBall, 128, 64), p.clearGlass),
          onTable(-0.03f, 0.13f) * place({0.0f, kBall * lift, 0.0f}));
    b.put("ball rest", b.mesh("ball rest", ballRest(kBall), p.gold),
          onTable(-0.03f, 0.13f) * place({0.0f, 0.012f, 0.0f}));
    b.put("glass vase", b.mesh("glass vase", glassVase(), p.tintedGlass), onTable(0.27f, -0.15f));
    b.put("copper ball", b.mesh("copper ball", sphere(kSmallBall, 96, 48), p.copper),
          onTable(0.55f, 0.10f) * place({0.0f, kSmallBall, 0.0f}));
    const uint32_t jar = b.mesh("amphora", amphora(), p.terracotta);
    b.put("amphora", jar, place({-5.35f, 0.0f, 4.95f}, 20.0f));
    b.put("amphora", jar, place({-5.0f, 0.0f, 5.55f}, 70.0f, glm::vec3(0.8f)));
}

}  // namespace

Scene makeCourtyard(const Geometry& statue) {
    Scene scene;
    scene.name = "Courtyard";
    scene.sky = SkyDescription{
        .sunElevationRadians = glm::radians(38.0f), .sunAzimuthRadians = glm::radians(104.0f), .turbidity = 2.5f};
    Builder builder(scene, addPalette(scene));
    addCamera(scene, "courtyard", {2.7f, 1.45f, 9.05f}, {3.1f, 1.82f, 0.0f}, glm::radians(39.0f));
    addCamera(scene, "statue", {1.3f, 2.3f, 2.3f}, {0.05f, 3.55f, -3.2f}, glm::radians(29.0f));
    addCamera(scene, "arcade", {-7.9f, 1.9f, 9.3f}, {-7.2f, 1.8f, 0.0f}, glm::radians(48.0f));
    const BuildingMeshes shared = addBuilding(builder);
    addTower(builder, shared.archWall, shared.archStones, shared.pier);
    addPool(builder, statue);
    addPlants(builder);
    addLandscape(builder);
    addStillLife(builder);
    return scene;
}

}  // namespace raylab::assets
