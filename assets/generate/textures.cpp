#include "assets/generate/textures.h"

#include <cmath>

#include "assets/generate/noise.h"

namespace raylab::assets {
namespace {

float smooth(float low, float high, float x) { return glm::smoothstep(low, high, x); }

glm::uvec2 cells(uint32_t n) { return {n, n}; }

/// Which tile of an n x n grid, as a number for hash01.
uint32_t tileId(glm::vec2 p, uint32_t n) {
    const glm::uvec2 t = glm::uvec2(glm::floor(p) + static_cast<float>(4 * n)) % n;
    return t.y * n + t.x;
}

/// 0 on the lines where |noise| is small, 1 away from them.
float veins(glm::vec2 uv, uint32_t n, float width, uint32_t seed) {
    const glm::vec2 warp(tileFbm(uv, cells(n), 4, seed + 10), tileFbm(uv, cells(n), 4, seed + 20));
    return smooth(0.0f, width, std::abs(tileFbm(uv + 0.35f * warp, cells(n), 3, seed)));
}

}  // namespace

SurfaceMaps paintPaving() {
    constexpr uint32_t kTiles = 4;
    constexpr float kInset = 0.2929f;  // makes the octagons regular
    return paintSurface({.size = 1024, .metres = kPavingMetres}, [](glm::vec2 uv) {
        const glm::vec2 p = uv * static_cast<float>(kTiles);
        const glm::vec2 toEdge = 0.5f - glm::abs(glm::fract(p) - 0.5f);
        const float toInset = (toEdge.x + toEdge.y - kInset) * 0.70711f;
        const bool inset = toInset < 0.0f;
        const float toJoint = inset ? -toInset : glm::min(toInset, glm::min(toEdge.x, toEdge.y));
        const float stone = smooth(0.004f, 0.011f, toJoint);
        const float bevel = smooth(0.006f, 0.035f, toJoint);
        const uint32_t id = inset ? 100 + tileId(p + 0.5f, kTiles) : tileId(p, kTiles);
        const float tone = hash01(id, 1) - 0.5f;
        const float grain = tileFbm(uv, cells(64), 4, 3);
        const float clouds = tileFbm(uv + glm::vec2(0.37f * hash01(id, 2), 0.61f * hash01(id, 3)), cells(8), 5, 5);
        const float wear = tileFbm(uv, cells(3), 5, 7);

        const glm::vec3 cream = glm::vec3(0.80f, 0.725f, 0.61f) + tone * glm::vec3(0.11f, 0.12f, 0.13f);
        const glm::vec3 red = glm::vec3(0.43f, 0.225f, 0.165f) + tone * glm::vec3(0.12f, 0.06f, 0.05f);
        glm::vec3 colour = inset ? red : cream;
        colour *= 1.0f + 0.13f * clouds + 0.08f * grain;
        colour = glm::mix(glm::vec3(0.45f, 0.39f, 0.32f) * (1.0f + 0.2f * grain), colour, stone);
        colour *= 0.97f + 0.10f * wear;

        SurfacePoint s{.colour = colour};
        s.height = 0.0035f * stone + 0.0012f * bevel + 0.0008f * clouds + 0.0003f * grain;
        s.roughness = glm::mix(0.9f, 0.40f + 0.22f * wear + 0.12f * grain - (inset ? 0.08f : 0.0f), stone);
        return s;
    });
}

SurfaceMaps paintPlaster() {
    return paintSurface({.size = 1024, .metres = kPlasterMetres, .roughness = false}, [](glm::vec2 uv) {
        const float blotches = tileFbm(uv, cells(3), 5, 11);
        const float strokes = tileFbm(uv, {12, 28}, 4, 13);
        const float grain = tileFbm(uv, cells(160), 3, 15);
        const float stains = smooth(0.05f, 0.5f, tileFbm(uv, {5, 2}, 5, 17));
        glm::vec3 colour = glm::mix(glm::vec3(0.90f, 0.79f, 0.62f), glm::vec3(0.85f, 0.70f, 0.51f), 0.5f + blotches);
        colour *= 1.0f + 0.05f * strokes + 0.04f * grain;
        colour = glm::mix(colour, glm::vec3(0.70f, 0.62f, 0.52f), 0.30f * stains);
        SurfacePoint s{.colour = colour};
        s.height = 0.006f * strokes + 0.010f * blotches + 0.0006f * grain;
        return s;
    });
}

SurfaceMaps paintLimestone() {
    return paintSurface({.metres = kLimestoneMetres, .roughness = false}, [](glm::vec2 uv) {
        const float clouds = tileFbm(uv, cells(3), 5, 21);
        const float grain = tileFbm(uv, cells(64), 3, 23);
        const float bedding = tileFbm(uv, {2, 18}, 3, 25);
        const float pits = smooth(0.33f, 0.5f, tileFbm(uv, cells(24), 3, 27));
        glm::vec3 colour = glm::vec3(0.815f, 0.765f, 0.67f) * (1.0f + 0.13f * clouds + 0.06f * grain + 0.05f * bedding);
        colour = glm::mix(colour, glm::vec3(0.52f, 0.46f, 0.38f), 0.6f * pits);
        SurfacePoint s{.colour = colour};
        s.height = 0.0012f * clouds + 0.0006f * grain + 0.0006f * bedding - 0.0016f * pits;
        return s;
    });
}

SurfaceMaps paintTerracottaFloor() {
    constexpr uint32_t kTiles = 4;
    return paintSurface({.metres = kTerracottaMetres}, [](glm::vec2 uv) {
        const glm::vec2 p = static_cast<float>(kTiles) * glm::vec2(uv.x + uv.y, uv.x - uv.y);
        const glm::vec2 toEdge = 0.5f - glm::abs(glm::fract(p) - 0.5f);
        const float toJoint = glm::min(toEdge.x, toEdge.y);
        const float tile = smooth(0.02f, 0.045f, toJoint);
        const glm::uvec2 t = glm::uvec2(glm::floor(p) + 40.0f);
        // Two tiles are the same when they differ by a whole repeat: (kTiles, kTiles) or (kTiles, -kTiles).
        const uint32_t id = (t.x + t.y) % (2 * kTiles) * 64 + (t.x + 64 - t.y) % (2 * kTiles);
        const float tone = hash01(id, 5) - 0.5f;
        const float clouds = tileFbm(uv, cells(6), 5, 31);
        const float grain = tileFbm(uv, cells(64), 3, 33);
        glm::vec3 colour = glm::vec3(0.67f, 0.40f, 0.275f) + tone * glm::vec3(0.14f, 0.11f, 0.09f);
        colour *= 1.0f + 0.16f * clouds + 0.06f * grain;
        colour = glm::mix(glm::vec3(0.46f, 0.36f, 0.28f), colour, tile);
        SurfacePoint s{.colour = colour};
        s.height = 0.003f * tile + 0.002f * smooth(0.03f, 0.14f, toJoint) + 0.001f * clouds + 0.0003f * grain;
        s.roughness = glm::mix(0.95f, 0.58f + 0.2f * clouds, tile);
        return s;
    });
}

SurfaceMaps paintRoofTile() {
    return paintSurface({.metres = kRoofMetres, .roughness = false}, [](glm::vec2 uv) {
        const float tone = tileFbm(uv, cells(24), 2, 41);
        const float clouds = tileFbm(uv, cells(6), 5, 43);
        const float grain = tileFbm(uv, cells(128), 2, 45);
        const float lichen = smooth(0.22f, 0.42f, tileFbm(uv, cells(40), 4, 47));
        glm::vec3 colour = glm::mix(glm::vec3(0.80f, 0.50f, 0.34f), glm::vec3(0.58f, 0.31f, 0.21f), 0.5f + 1.1f * tone);
        colour *= 1.0f + 0.22f * clouds + 0.08f * grain;
        colour = glm::mix(colour, glm::vec3(0.72f, 0.68f, 0.52f), 0.55f * lichen);
        return SurfacePoint{.colour = colour, .height = 0.002f * clouds + 0.0008f * grain + 0.0008f * lichen};
    });
}

SurfaceMaps paintWood() {
    return paintSurface({.metres = kWoodMetres, .roughness = false}, [](glm::vec2 uv) {
        const float drift = tileFbm(uv, {2, 6}, 3, 51);
        const float fibre = tileFbm(uv, {4, 96}, 3, 53);
        const float rings = 0.5f + 0.5f * std::sin(6.2831853f * (6.0f * uv.y + 1.6f * drift));
        const float dark = 0.45f * rings + 0.6f * fibre;
        const glm::vec3 colour = glm::mix(glm::vec3(0.44f, 0.295f, 0.185f), glm::vec3(0.245f, 0.15f, 0.09f), dark);
        return SurfacePoint{.colour = colour, .height = 0.0015f * fibre + 0.0008f * rings};
    });
}

SurfaceMaps paintMarble() {
    return paintSurface({.metres = kMarbleMetres, .relief = false, .roughness = false}, [](glm::vec2 uv) {
        const float clouds = tileFbm(uv, cells(3), 5, 61);
        const float vein = 0.65f * (1.0f - veins(uv, 2, 0.10f, 63)) + 0.35f * (1.0f - veins(uv, 5, 0.05f, 67));
        const float strength = smooth(-0.3f, 0.5f, tileFbm(uv, cells(2), 3, 69));
        glm::vec3 colour = glm::vec3(0.925f, 0.915f, 0.895f) * (1.0f + 0.035f * clouds);
        colour = glm::mix(colour, glm::vec3(0.74f, 0.73f, 0.725f), 0.55f * vein * strength);
        return SurfacePoint{.colour = colour};
    });
}

SurfaceMaps paintWater() {
    return paintSurface({.metres = kWaterMetres, .roughness = false}, [](glm::vec2 uv) {
        const float swell = tileFbm(uv, cells(3), 2, 71);
        const float ripples = tileFbm(uv + 0.02f * swell, {9, 7}, 2, 73);
        return SurfacePoint{.colour = glm::vec3(1.0f), .height = 0.006f * swell + 0.0022f * ripples};
    });
}

}  // namespace raylab::assets
