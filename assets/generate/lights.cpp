#include "assets/generate/lights.h"

#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "assets/generate/noise.h"
#include "assets/generate/scene_tools.h"

namespace raylab::assets {
namespace {

constexpr float kHalfX = 190.0f;
constexpr float kNear = 90.0f;  ///< towards the camera
constexpr float kFar = -310.0f;
constexpr uint32_t kStreetLanterns = 2800;
constexpr uint32_t kFloatingLanterns = 700;
constexpr uint32_t kHouses = 1100;

/// The bay lies in the middle; its shore rises to hills at the far side and both flanks.
float groundHeight(glm::vec2 p) {
    const glm::vec2 fromBay = (p - glm::vec2(0.0f, 10.0f)) / glm::vec2(118.0f, 95.0f);
    const float shore = glm::length(fromBay) + 0.10f * noise3(glm::vec3(p.x, 0.0f, p.y) / 40.0f, 601) - 1.0f;
    const float rise = 62.0f * glm::smoothstep(0.0f, 2.1f, shore) + 4.0f * glm::smoothstep(-0.05f, 0.06f, shore) - 3.0f;
    const float rolling = 9.0f * noise3(glm::vec3(p.x, 5.0f, p.y) / 52.0f, 602) * glm::smoothstep(0.05f, 0.8f, shore);
    return rise + rolling;
}

glm::vec3 onGround(glm::vec2 p) { return {p.x, groundHeight(p), p.y}; }

Geometry ground() {
    return parametricSurface(220, 220, [](float u, float v) {
        return onGround({glm::mix(-kHalfX, kHalfX, u), glm::mix(kNear, kFar, v)});
    });
}

/// Lights of one colour as one mesh.
struct Glow {
    const char* name;
    glm::vec3 radiance;
    Geometry geometry = {};
};

enum GlowKind : size_t { warmWindow, coolWindow, streetLantern, redLantern, goldLantern, kGlowKinds };

using Glows = std::array<Glow, kGlowKinds>;

/// Eight triangles about `centre`.
void appendOctahedron(Geometry& g, glm::vec3 centre, glm::vec3 half) {
    const glm::vec3 x(half.x, 0.0f, 0.0f), y(0.0f, half.y, 0.0f), z(0.0f, 0.0f, half.z);
    const auto base = static_cast<uint32_t>(g.positions.size());
    for (const glm::vec3& corner : {x, -x, y, -y, z, -z}) {
        g.positions.push_back(centre + corner);
        g.normals.push_back(glm::normalize(corner));
        g.uvs.emplace_back(0.0f);
    }
    constexpr glm::uvec3 kFaces[] = {{0, 2, 4}, {4, 2, 1}, {1, 2, 5}, {5, 2, 0},
                                     {4, 3, 0}, {1, 3, 4}, {5, 3, 1}, {0, 3, 5}};
    for (const glm::uvec3& face : kFaces) g.triangles.push_back(face + base);
}

struct Village {
    Geometry walls;
    Geometry roofs;
    std::vector<glm::mat4> windows;  ///< a unit square in XY that faces +Z
};

/// Foot in the ground at the origin, gables along X; `size`: width, height of the eaves, depth.
void appendHouse(Village& village, const glm::mat4& pose, glm::vec3 size, Dice& dice) {
    const float w = 0.5f * size.x, d = 0.5f * size.z, eaves = size.y, ridge = size.y + 0.42f * size.z;
    append(village.walls, box({-w, -3.0f, -d}, {w, eaves, d}), pose);
    Geometry roof;
    const float over = 0.25f;
    const float low = eaves - over * (ridge - eaves) / d;
    appendQuad(roof, {-w - over, low, d + over}, {w + over, low, d + over}, {w + over, ridge, 0.0f},
               {-w - over, ridge, 0.0f}, {}, {});
    appendQuad(roof, {w + over, low, -d - over}, {-w - over, low, -d - over}, {-w - over, ridge, 0.0f},
               {w + over, ridge, 0.0f}, {}, {});
    append(village.roofs, roof, pose);
    Geometry gables;
    for (const float side : {-1.0f, 1.0f})
        appendQuad(gables, {side * w, eaves, side * d}, {side * w, eaves, -side * d}, {side * w, ridge, 0.0f},
                   {side * w, ridge, 0.0f}, {}, {});
    append(village.walls, gables, pose);
    const int storeys = eaves > 4.5f ? 2 : 1;
    for (int side = 0; side < 4; ++side) {
        const bool alongX = side % 2 == 0;
        const float reach = alongX ? d : w, length = alongX ? w : d;
        for (int storey = 0; storey < storeys; ++storey)
            for (const float at : {-0.5f, 0.5f}) {
                if (dice.roll() > 0.62f) continue;
                const glm::mat4 face = place(glm::vec3(0.0f), 90.0f * static_cast<float>(side));
                const glm::vec3 middle(at * length, 1.5f + 2.6f * static_cast<float>(storey), reach + 0.02f);
                village.windows.push_back(pose * face * place(middle, 0.0f, {0.75f, 1.05f, 1.0f}));
            }
    }
}

/// A place on the shore or the slope above it, thinning out uphill.
glm::vec2 dwellingPlace(Dice& dice) {
    for (;;) {
        const float x = dice.roll(-kHalfX + 10.0f, kHalfX - 10.0f);
        const float z = dice.roll(kFar + 90.0f, kNear - 10.0f);
        const float height = groundHeight({x, z});
        if (height > 1.2f && dice.roll() < std::exp(-height / 17.0f)) return {x, z};
    }
}

Village buildVillage() {
    Village village;
    Dice dice(611);
    for (uint32_t i = 0; i < kHouses; ++i) {
        const glm::vec2 at = dwellingPlace(dice);
        // Gables look along the slope, as houses above a shore do.
        const float towardsBay = glm::degrees(std::atan2(-at.x, 10.0f - at.y));
        const float yaw = towardsBay + dice.roll(-22.0f, 22.0f);
        const glm::vec3 size{dice.roll(5.0f, 9.0f), dice.roll() < 0.45f ? 5.4f : 3.0f, dice.roll(4.5f, 6.5f)};
        appendHouse(village, place(onGround(at), yaw), size, dice);
    }
    return village;
}

/// Lanterns stand along paths: lines of equal height round the bay and steps between them.
void addStreetLanterns(Glows& glows, uint32_t count) {
    Dice dice(621);
    for (uint32_t made = 0; made < count;) {
        const float level = 1.6f + 4.2f * std::floor(dice.roll(0.0f, 6.99f));
        const float angle = dice.roll(0.0f, glm::two_pi<float>());
        const glm::vec2 out(std::cos(angle), std::sin(angle));
        float inner = 30.0f, outer = 330.0f;
        for (int i = 0; i < 24; ++i) {
            const float middle = 0.5f * (inner + outer);
            (groundHeight(glm::vec2(0.0f, 10.0f) + middle * out) < level ? inner : outer) = middle;
        }
        const glm::vec2 p = glm::vec2(0.0f, 10.0f) + inner * out;
        if (std::abs(p.x) > kHalfX - 2.0f || p.y > kNear - 2.0f || p.y < kFar + 2.0f) continue;
        appendOctahedron(glows[streetLantern].geometry, onGround(p) + glm::vec3(0.0f, 2.6f, 0.0f), glm::vec3(0.22f));
        ++made;
    }
}

void addFloatingLanterns(Glows& glows, uint32_t count) {
    Dice dice(631);
    for (uint32_t made = 0; made < count;) {
        // Two streams that drift apart, seen from the near shore.
        const float along = dice.roll();
        const float z = glm::mix(72.0f, -70.0f, along);
        const float bend = 26.0f * std::sin(3.4f * along + 0.4f);
        const float spread = (dice.roll() + dice.roll() + dice.roll() - 1.5f) * glm::mix(12.0f, 46.0f, along);
        const glm::vec2 p(bend + spread, z);
        if (groundHeight(p) > -0.6f) continue;
        const GlowKind kind = dice.roll() < 0.45f ? redLantern : goldLantern;
        appendOctahedron(glows[kind].geometry, {p.x, 0.26f, p.y}, {0.17f, 0.22f, 0.17f});
        ++made;
    }
}

/// `count` of them, evenly among the houses.
void addWindows(Glows& glows, const Village& village, size_t count) {
    Dice dice(641);
    Geometry pane;
    appendQuad(pane, {-0.5f, -0.5f, 0.0f}, {0.5f, -0.5f, 0.0f}, {0.5f, 0.5f, 0.0f}, {-0.5f, 0.5f, 0.0f}, {}, {});
    const size_t all = village.windows.size();
    for (size_t i = 0; i < all; ++i)
        if ((i + 1) * count / all > i * count / all)
            append(glows[dice.roll() < 0.85f ? warmWindow : coolWindow].geometry, pane, village.windows[i]);
}

void add(Scene& scene, const char* name, const Geometry& g, const Material& material) {
    addInstance(scene, name, addMesh(scene, name, g, addMaterial(scene, material)));
}

Material waterMaterial() {
    Material water = plainMaterial("water", {0.004f, 0.010f, 0.014f}, 0.0f);
    water.ior = 1.33f;
    return water;
}

}  // namespace

Scene makeLights() {
    Scene scene;
    scene.name = "Lights";
    // The moon: the sun's light, some 400,000 times weaker, made brighter again by a long exposure.
    scene.sky = SkyDescription{.sunElevationRadians = glm::radians(24.0f),
                               .sunAzimuthRadians = glm::radians(310.0f),
                               .turbidity = 2.0f,
                               .scale = 0.05f};
    Glows glows = {{{"warm window", {2.6f, 1.25f, 0.38f}},
                    {"cool window", {1.3f, 1.6f, 1.9f}},
                    {"street lantern", {60.0f, 30.0f, 9.5f}},
                    {"red lantern", {4.2f, 0.75f, 0.30f}},
                    {"gold lantern", {5.0f, 2.4f, 0.5f}}}};
    const Village village = buildVillage();
    addStreetLanterns(glows, kStreetLanterns);
    addFloatingLanterns(glows, kFloatingLanterns);
    addWindows(glows, village, kLightCount - kStreetLanterns - kFloatingLanterns);
    add(scene, "ground", ground(), plainMaterial("grass", {0.10f, 0.115f, 0.06f}, 1.0f));
    add(scene, "walls", village.walls, plainMaterial("wall", {0.62f, 0.55f, 0.46f}, 1.0f));
    add(scene, "roofs", village.roofs, plainMaterial("roof", {0.24f, 0.10f, 0.07f}, 0.9f));
    Geometry water;
    appendQuad(water, {-kHalfX, 0.0f, kNear}, {kHalfX, 0.0f, kNear}, {kHalfX, 0.0f, kFar}, {-kHalfX, 0.0f, kFar}, {},
               {});
    add(scene, "water", water, waterMaterial());
    for (const Glow& glow : glows) {
        Material lit = plainMaterial(glow.name, glm::vec3(0.6f), 1.0f);
        lit.emission = glow.radiance;
        add(scene, glow.name, glow.geometry, lit);
    }
    addCamera(scene, "bay", {14.0f, 13.0f, 84.0f}, {-6.0f, 5.5f, -40.0f}, glm::radians(37.0f));
    return scene;
}

}  // namespace raylab::assets
