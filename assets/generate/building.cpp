#include "assets/generate/building.h"

#include <cmath>

#include "assets/generate/architecture.h"
#include "assets/generate/noise.h"
#include "assets/generate/ornaments.h"

namespace raylab::assets {
namespace {

/// One side of the court. Its local frame: +Z towards the court, X along the side, origin in the court's middle.
struct Side {
    float yawDegrees;
    float distance;
    int bays;
    bool gallery;     ///< covered walk behind the arches; otherwise a free-standing screen
    float extendLow;  ///< how far the roof and walls run on at the low and high end of X
    float extendHigh;
};

/// Middle of bay `i`, along the side.
float bayMiddle(const Side& side, int i) {
    return (static_cast<float>(i) - 0.5f * static_cast<float>(side.bays - 1)) * kBay;
}

glm::mat4 onSide(const Side& side, glm::vec3 local, float turnDegrees = 0.0f) {
    return place(glm::vec3(0.0f), side.yawDegrees) * place(local + glm::vec3(0.0f, 0.0f, -side.distance), turnDegrees);
}

/// Meshes that every side repeats.
struct ArcadeMeshes {
    explicit ArcadeMeshes(Builder& b)
        : column(b.stone("column", raylab::assets::column())),
          pier(b.stone("pier", raylab::assets::pier())),
          wall(b.mesh("arch wall", archWall(), b.palette().plaster, kPlasterMetres)),
          stones(b.stone("arch stones", archStones())),
          cornice(b.stone("cornice", raylab::assets::cornice())),
          steps(b.stone("steps", raylab::assets::steps())),
          baluster(b.stone("baluster", raylab::assets::baluster())),
          rails(b.stone("balustrade rails", balustradeRails())),
          beam(b.mesh("beam", ceilingBeam(), b.palette().wood, kWoodMetres)),
          door(b.mesh("door", doorLeaf(), b.palette().wood, kWoodMetres)),
          doorFrame(b.stone("door frame", raylab::assets::doorFrame())),
          lantern(b.mesh("lantern", lanternMetal(), b.palette().iron)),
          lanternLight(b.mesh("lantern light", raylab::assets::lanternLight(), b.palette().lanternLight)) {
        for (uint32_t i = 0; i < 4; ++i)
            roof.push_back(b.mesh("roof strip", roofStrip(i), b.palette().roofTile, kRoofMetres));
    }
    uint32_t column, pier, wall, stones, cornice, steps, baluster, rails, beam, door, doorFrame, lantern, lanternLight;
    std::vector<uint32_t> roof;
};

void putArcade(Builder& b, const ArcadeMeshes& m, const Side& side) {
    for (int i = 0; i < side.bays; ++i) {
        const float x = bayMiddle(side, i);
        if (i > 0) b.put("column", m.column, onSide(side, {x - 0.5f * kBay, kGalleryFloor, 0.0f}));
        const glm::mat4 bay = onSide(side, {x, kGalleryFloor, 0.0f});
        b.put("arch wall", m.wall, bay);
        b.put("arch stones", m.stones, bay);
        b.put("cornice", m.cornice, bay);
        b.put("steps", m.steps, onSide(side, {x, 0.0f, 0.0f}));
    }
    b.put("pier", m.pier, onSide(side, {-0.5f * kBay * static_cast<float>(side.bays), kGalleryFloor, 0.0f}));
}

/// The screen has an outer face like its inner one, and balusters between its columns.
void putScreen(Builder& b, const ArcadeMeshes& m, const Side& side) {
    for (int i = 0; i < side.bays; ++i) {
        const float x = bayMiddle(side, i);
        b.put("cornice", m.cornice, onSide(side, {x, kGalleryFloor, 0.0f}, 180.0f));
        b.put("steps", m.steps, onSide(side, {x, 0.0f, 0.0f}, 180.0f));
        b.put("balustrade rails", m.rails, onSide(side, {x, kGalleryFloor, 0.0f}));
        for (int k = 0; k < 9; ++k) {
            const float at = x + 0.2f * static_cast<float>(k - 4);
            b.put("baluster", m.baluster, onSide(side, {at, kGalleryFloor + kBalusterFoot, 0.0f}));
        }
    }
}

void putRoof(Builder& b, const ArcadeMeshes& m, const Side& side, uint32_t seed) {
    Dice dice(seed);
    const float half = 0.5f * kBay * static_cast<float>(side.bays);
    const float low = -half - side.extendLow;
    const float high = half + side.extendHigh;
    const auto strips = static_cast<int>(std::round((high - low) / kRoofStripWidth));
    for (int i = 0; i < strips; ++i) {
        const float x = low + (static_cast<float>(i) + 0.5f) * kRoofStripWidth;
        const auto variant = static_cast<size_t>(dice.roll(0.0f, 3.999f));
        b.put("roof strip", m.roof[variant], onSide(side, {x, kGalleryFloor + kWallTop + 0.10f, 0.50f}));
    }
}

/// Floor, back wall, ceiling and the solid under the roof of one covered walk: stored once a side, being of one piece.
void putWalk(Builder& b, const Side& side) {
    const float half = 0.5f * kBay * static_cast<float>(side.bays);
    const float low = -half - side.extendLow;
    const float high = half + side.extendHigh;
    const float front = 0.5f * kWallThickness;
    const float back = -kGalleryDepth - front;
    const float floor = kGalleryFloor;
    const float top = floor + kWallTop;
    Geometry floorSlab;
    appendQuad(floorSlab, {low, floor, -front}, {high, floor, -front}, {high, floor, back}, {low, floor, back},
               {low, -front}, {high, back});
    b.put("walk floor", b.mesh("walk floor", floorSlab, b.palette().terracottaFloor, kTerracottaMetres),
          onSide(side, {}));
    const Geometry wall = box({low, floor, back - 0.4f}, {high, top, back});
    b.put("walk wall", b.mesh("walk wall", wall, b.palette().plaster, kPlasterMetres), onSide(side, {}));
    const Geometry ceiling = box({low, top - 0.05f, back}, {high, top, -front});
    b.put("walk ceiling", b.mesh("walk ceiling", ceiling, b.palette().wood, kWoodMetres), onSide(side, {}));
    const float rise = (kGalleryDepth + 0.9f) * std::tan(glm::radians(kRoofPitchDegrees));
    const glm::vec2 wedge[3] = {
        {-0.35f, top + 0.05f}, {kGalleryDepth + 0.55f, top + 0.05f}, {kGalleryDepth + 0.55f, top + 0.05f + rise}};
    const Geometry body = extrude(wedge, low, high, 0.01f);
    b.put("roof body", b.mesh("roof body", body, b.palette().plaster, kPlasterMetres),
          onSide(side, {}, 90.0f) * place({0.0f, 0.0f, 0.0f}));
}

void putDoorsAndLanterns(Builder& b, const ArcadeMeshes& m, const Side& side) {
    const float back = -kGalleryDepth - 0.5f * kWallThickness;
    for (int i = 0; i < side.bays; ++i) {
        const float x = bayMiddle(side, i);
        const glm::mat4 hook = onSide(side, {x, kGalleryFloor + kWallTop - 0.05f, -0.5f * kGalleryDepth});
        b.put("lantern", m.lantern, hook);
        b.put("lantern light", m.lanternLight, hook);
        for (int k = -1; k <= 1; ++k) {
            const float at = x + static_cast<float>(k) * kBay / 3.0f;
            b.put("beam", m.beam, onSide(side, {at, kGalleryFloor + kWallTop - 0.25f, -0.5f * kGalleryDepth - 0.23f}));
        }
        if (i % 2 == 1) {
            b.put("door", m.door, onSide(side, {x, kGalleryFloor, back}));
            b.put("door frame", m.doorFrame, onSide(side, {x, kGalleryFloor, back}));
        }
    }
}

void putPaving(Builder& b) {
    Geometry floor;
    appendQuad(floor, {-kCourtHalfX, 0.0f, kCourtHalfZ}, {kCourtHalfX, 0.0f, kCourtHalfZ},
               {kCourtHalfX, 0.0f, -kCourtHalfZ}, {-kCourtHalfX, 0.0f, -kCourtHalfZ}, {-kCourtHalfX, kCourtHalfZ},
               {kCourtHalfX, -kCourtHalfZ});
    b.putOnce("paving", b.mesh("paving", floor, b.palette().paving, kPavingMetres));
}

}  // namespace

BuildingMeshes addBuilding(Builder& builder) {
    const float corner = kGalleryDepth + 0.6f;
    const Side left{90.0f, kCourtHalfX, 8, true, corner, corner};
    const Side back{0.0f, kCourtHalfZ, 5, true, corner, 0.35f};
    const Side front{180.0f, kCourtHalfZ, 5, true, 0.35f, corner};
    const Side right{-90.0f, kCourtHalfX, 8, false, 0.0f, 0.0f};
    const ArcadeMeshes meshes(builder);
    putPaving(builder);
    uint32_t seed = 300;
    for (const Side& side : {left, back, front, right}) {
        putArcade(builder, meshes, side);
        if (side.gallery) {
            putRoof(builder, meshes, side, ++seed);
            putWalk(builder, side);
            putDoorsAndLanterns(builder, meshes, side);
        } else {
            putScreen(builder, meshes, side);
        }
    }
    return {meshes.wall, meshes.stones, meshes.pier};
}

}  // namespace raylab::assets
