#include "assets/generate/water.h"

#include <array>
#include <cmath>
#include <numbers>

#include "assets/generate/architecture.h"
#include "assets/generate/noise.h"
#include "assets/generate/scene_tools.h"
#include "assets/generate/textures.h"

namespace raylab::assets {
namespace {

constexpr float kPool = 2.6f;     ///< radius
constexpr float kDepth = 1.45f;   ///< of the basin, below the floor of the hall
constexpr float kLevel = -0.14f;  ///< of the water
constexpr float kHall = 6.2f;     ///< radius of the wall
constexpr float kCornice = 4.2f;  ///< where the dome starts
constexpr float kColumnRing = 4.7f;
constexpr int kColumns = 16;
constexpr float kLampHeight = 5.2f;
constexpr float kMosaicMetres = 0.8f;
constexpr int kTiles = 16;  ///< across one repeat of the mosaic
constexpr uint32_t kWaterCells = 300;
constexpr uint32_t kSeed = 0x77a7e2u;
constexpr float kTwoPi = 2.0f * std::numbers::pi_v<float>;

/// A train of waves. Light focuses at depth d where amplitude x number^2 = n / ((n - 1) d).
struct Wave {
    glm::vec2 number;  ///< radians a metre
    float amplitude;
    float phase;
};

std::array<Wave, 14> makeWaves() {
    constexpr float kFocus = 0.62f;  // of each train; together they focus at about the basin's depth
    std::array<Wave, 14> waves{};
    Dice dice(kSeed);
    for (size_t i = 0; i < waves.size(); ++i) {
        const float length = 0.26f * std::pow(3.6f, static_cast<float>(i) / static_cast<float>(waves.size() - 1));
        const float number = kTwoPi / length;
        const float direction = dice.roll(0.0f, kTwoPi);
        const float phase = dice.roll(0.0f, kTwoPi);
        waves[i] = {number * glm::vec2(std::cos(direction), std::sin(direction)), kFocus / (number * number), phase};
    }
    return waves;
}

/// A square sheet, whose corners are hidden below the floor of the hall.
Geometry waterSurface() {
    const std::array<Wave, 14> waves = makeWaves();
    const auto place2 = [](float u, float v) { return (glm::vec2(u, 1.0f - v) * 2.0f - 1.0f) * (kPool + 0.02f); };
    const auto phase = [](const Wave& wave, glm::vec2 p) { return glm::dot(wave.number, p) + wave.phase; };
    Geometry g = parametricSurface(kWaterCells, kWaterCells, [&](float u, float v) {
        const glm::vec2 p = place2(u, v);
        float height = kLevel;
        for (const Wave& wave : waves) height += wave.amplitude * std::sin(phase(wave, p));
        return glm::vec3(p.x, height, p.y);
    });
    for (size_t i = 0; i < g.positions.size(); ++i) {
        const glm::vec2 p(g.positions[i].x, g.positions[i].z);
        glm::vec2 slope(0.0f);
        for (const Wave& wave : waves) slope += wave.amplitude * std::cos(phase(wave, p)) * wave.number;
        g.normals[i] = glm::normalize(glm::vec3(-slope.x, 1.0f, -slope.y));
    }
    return g;
}

/// Small glazed tiles between white grout, each of its own blue or green.
SurfaceMaps paintMosaic() {
    return paintSurface({.size = 512, .metres = kMosaicMetres}, [](glm::vec2 uv) {
        const glm::vec2 at = uv * static_cast<float>(kTiles), cell = glm::floor(at),
                        inside = glm::abs(at - cell - 0.5f);
        const float toEdge = 0.5f - glm::max(inside.x, inside.y);
        const auto x = static_cast<uint32_t>(cell.x), y = static_cast<uint32_t>(cell.y);
        const float shade = hash01(x, y, kSeed), hue = hash01(x, y, kSeed + 1);
        if (toEdge < 0.05f) return SurfacePoint{.colour = {0.86f, 0.85f, 0.80f}, .height = -0.0015f, .roughness = 0.9f};
        const glm::vec3 blue(0.42f, 0.66f, 0.74f), green(0.55f, 0.76f, 0.72f);
        return SurfacePoint{.colour = glm::mix(blue, green, hue) * (0.86f + 0.28f * shade),
                            .height = -0.0015f * glm::smoothstep(0.12f, 0.05f, toEdge),
                            .roughness = 0.25f};
    });
}

void addStone(Scene& scene, const char* name, Geometry g, uint32_t material, float metres,
              const glm::mat4& pose = glm::mat4(1.0f)) {
    scaleUvs(g, glm::vec2(1.0f / metres));
    addInstance(scene, name, addMesh(scene, name, g, material), pose);
}

/// Surfaces of revolution that are seen from within run from the top down.
void addHall(Scene& scene) {
    const uint32_t limestone = addMaterial(scene, texturedMaterial(scene, "limestone", paintLimestone(), 0.85f));
    const uint32_t plaster = addMaterial(scene, texturedMaterial(scene, "plaster", paintPlaster(), 0.95f));
    const uint32_t paving = addMaterial(scene, texturedMaterial(scene, "paving", paintPaving(), 1.0f));
    Geometry floor = lathe({line({kHall, 0.0f}, {kPool, 0.0f})}, 96);
    projectUvs(floor, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f});
    addStone(scene, "floor", floor, paving, kPavingMetres);
    const float foot = kCornice + 0.5f;
    addStone(scene, "dome", lathe({profileArc({0.0f, foot}, kHall - 0.1f, 90.0f, 0.0f, 32)}, 128), plaster,
             kPlasterMetres);
    addStone(
        scene, "wall",
        lathe({line({kHall - 0.1f, foot}, {kHall - 0.3f, foot}), line({kHall - 0.3f, foot}, {kHall - 0.3f, kCornice}),
               line({kHall - 0.3f, kCornice}, {kHall, kCornice}), line({kHall, kCornice}, {kHall, 0.0f})},
              128),
        limestone, kLimestoneMetres);
    const float r = kColumnRing, low = kSpringing;
    addStone(scene, "entablature",
             lathe({line({r - 0.24f, low}, {r + 0.24f, low}), line({r + 0.24f, low}, {r + 0.24f, low + 0.34f}),
                    profileArc({r + 0.24f, low + 0.43f}, 0.09f, -90.0f, 0.0f, 8),
                    line({r + 0.33f, low + 0.43f}, {r + 0.33f, low + 0.52f}),
                    line({r + 0.33f, low + 0.52f}, {r - 0.24f, low + 0.52f}),
                    line({r - 0.24f, low + 0.52f}, {r - 0.24f, low})},
                   160),
             limestone, kLimestoneMetres);
    Geometry shaft = column();
    scaleUvs(shaft, glm::vec2(1.0f / kLimestoneMetres));
    const uint32_t columnMesh = addMesh(scene, "column", shaft, limestone);
    for (int i = 0; i < kColumns; ++i) {
        const float degrees = 360.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(kColumns);
        addInstance(scene, "column", columnMesh, place(glm::vec3(0.0f), degrees) * place({0.0f, 0.0f, kColumnRing}));
    }
    addStone(
        scene, "curb",
        lathe({line({kPool + 0.45f, 0.0f}, {kPool + 0.45f, 0.06f}),
               profileArc({kPool + 0.40f, 0.06f}, 0.05f, 0.0f, 90.0f, 8), line({kPool + 0.40f, 0.11f}, {kPool, 0.11f}),
               profileArc({kPool, 0.06f}, 0.05f, 90.0f, 180.0f, 8),
               line({kPool - 0.05f, 0.06f}, {kPool - 0.05f, -0.06f}), line({kPool - 0.05f, -0.06f}, {kPool, -0.06f})},
              128),
        limestone, kLimestoneMetres);
}

void addPool(Scene& scene) {
    const uint32_t mosaic = addMaterial(scene, texturedMaterial(scene, "mosaic", paintMosaic(), 1.0f));
    addStone(scene, "basin wall", lathe({line({kPool, 0.0f}, {kPool, -kDepth})}, 128), mosaic, kMosaicMetres);
    Geometry bottom = lathe({line({kPool, -kDepth}, {0.0f, -kDepth})}, 96);
    projectUvs(bottom, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f});
    addStone(scene, "basin floor", bottom, mosaic, kMosaicMetres);
    Material water = glassMaterial("water", {0.97f, 0.99f, 1.0f});
    water.ior = 1.33f;
    addInstance(scene, "water", addMesh(scene, "water", waterSurface(), addMaterial(scene, water)));
}

void addOrnaments(Scene& scene) {
    const uint32_t marble = addMaterial(scene, texturedMaterial(scene, "marble", paintMarble(), 0.35f));
    const uint32_t gold = addMaterial(scene, plainMaterial("gold", {1.0f, 0.71f, 0.29f}, 0.15f, 1.0f));
    const uint32_t glass = addMaterial(scene, glassMaterial("glass", {0.99f, 1.0f, 0.995f}));
    addStone(scene, "pedestal", pedestal(1.7f, 0.3f), marble, kMarbleMetres, place({-0.55f, -kDepth, -0.6f}, 20.0f));
    addInstance(scene, "glass ball", addMesh(scene, "glass ball", sphere(0.3f, 96, 48), glass),
                place({-0.55f, 1.7f - kDepth + 0.3f, -0.6f}));
    addInstance(scene, "gold ball", addMesh(scene, "gold ball", sphere(0.28f, 96, 48), gold),
                place({0.75f, 0.28f - kDepth, 0.35f}));
    Material lamp = plainMaterial("lamp", glm::vec3(0.0f), 1.0f);
    lamp.emission = glm::vec3(62.0f, 56.0f, 47.0f);
    addInstance(scene, "lamp", addMesh(scene, "lamp", sphere(0.55f, 32, 16), addMaterial(scene, lamp)),
                place({0.5f, kLampHeight, 0.3f}));
}

}  // namespace

Scene makeWater() {
    Scene scene;
    scene.name = "Water";
    addHall(scene);
    addPool(scene);
    addOrnaments(scene);
    addCamera(scene, "bath", {2.9f, 1.95f, 3.7f}, {-0.25f, -0.55f, -0.3f}, glm::radians(52.0f));
    addCamera(scene, "below", {1.7f, -1.05f, 1.55f}, {-0.6f, -0.35f, -0.7f}, glm::radians(68.0f));
    addCamera(scene, "floor", {0.3f, 3.4f, 0.9f}, {0.1f, -kDepth, 0.1f}, glm::radians(48.0f));
    return scene;
}

}  // namespace raylab::assets
