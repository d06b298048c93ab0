#include "assets/generate/architecture.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "assets/generate/noise.h"

namespace raylab::assets {
namespace {

constexpr float kPi = glm::pi<float>();

/// A quarter or half round standing out of a lathe: convex, from `lowY` to `highY`.
std::vector<glm::vec2> torusRoll(float radius, float lowY, float highY) {
    const float r = 0.5f * (highY - lowY);
    return profileArc({radius, lowY + r}, r, -90.0f, 90.0f, 8);
}

glm::vec2 onArc(float radius, float angle) { return {radius * std::cos(angle), kSpringing + radius * std::sin(angle)}; }

/// Where a ray from the arch's centre at `angle` leaves the bay's rectangle.
glm::vec2 onBayOutline(float angle) {
    const glm::vec2 d(std::cos(angle), std::sin(angle));
    const float toSide = std::abs(d.x) > 1e-6f ? 0.5f * kBay / std::abs(d.x) : 1e9f;
    const float toTop = d.y > 1e-6f ? (kWallTop - kSpringing) / d.y : 1e9f;
    return glm::vec2(0.0f, kSpringing) + glm::min(toSide, toTop) * d;
}

/// Half a tapering barrel, its lower end at z = 0 with the clay's thickness to be seen: a cover that arches upwards or
/// a channel that lies between two covers. `patch` is where on the texture it lies.
Geometry roofTile(bool cover, glm::vec2 patch) {
    constexpr float kLength = 0.46f;
    constexpr float kClay = 0.016f;
    const glm::vec2 radii = cover ? glm::vec2(0.098f, 0.078f) : glm::vec2(0.085f, 0.105f);
    const auto onBarrel = [&](float u, float radius, float along) {
        const float angle = kPi * (cover ? 1.0f - u : 1.0f + u);
        return glm::vec3(radius * std::cos(angle), (cover ? 0.075f : 0.09f) + radius * std::sin(angle), -along);
    };
    Geometry tile = parametricSurface(
        12, 1, [&](float u, float v) { return onBarrel(u, glm::mix(radii.x, radii.y, v), kLength * v); });
    const float inward = cover ? -kClay : kClay;
    append(tile, parametricSurface(12, 1,
                                   [&](float u, float v) { return onBarrel(u, radii.x + inward * (1.0f - v), 0.0f); }));
    for (glm::vec2& uv : tile.uvs) uv = patch + uv * glm::vec2(0.3f, kLength);
    return tile;
}

}  // namespace

Geometry extrude(std::span<const glm::vec2> polygon, float zLow, float zHigh, float bevel) {
    glm::vec2 centre(0.0f);
    for (const glm::vec2& p : polygon) centre += p / static_cast<float>(polygon.size());
    const auto shrunk = [&](glm::vec2 p) { return p - bevel * glm::normalize(p - centre); };
    Geometry g;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const glm::vec2 p = polygon[i];
        const glm::vec2 q = polygon[(i + 1) % polygon.size()];
        const glm::vec2 ps = shrunk(p);
        const glm::vec2 qs = shrunk(q);
        const float length = glm::distance(p, q);
        appendQuad(g, {p, zHigh - bevel}, {p, zLow + bevel}, {q, zLow + bevel}, {q, zHigh - bevel}, {zHigh, length},
                   {zLow, 0.0f});
        appendQuad(g, {ps, zHigh}, {p, zHigh - bevel}, {q, zHigh - bevel}, {qs, zHigh}, {0.0f, bevel}, {length, 0.0f});
        appendQuad(g, {p, zLow + bevel}, {ps, zLow}, {qs, zLow}, {q, zLow + bevel}, {0.0f, bevel}, {length, 0.0f});
        for (const bool front : {true, false}) {
            const auto base = static_cast<uint32_t>(g.positions.size());
            const float z = front ? zHigh : zLow;
            for (const glm::vec2 corner : {centre, front ? ps : qs, front ? qs : ps}) {
                g.positions.emplace_back(corner, z);
                g.normals.emplace_back(0.0f, 0.0f, front ? 1.0f : -1.0f);
                g.uvs.emplace_back(corner.x, -corner.y);
            }
            g.triangles.emplace_back(base, base + 1, base + 2);
        }
    }
    return g;
}

Geometry column() {
    Geometry g = rectangularLathe({line({0.27f, 0.0f}, {0.27f, 0.13f}), line({0.27f, 0.13f}, {0.0f, 0.13f})}, {0, 0});
    std::vector<glm::vec2> shaft;
    for (int i = 0; i <= 24; ++i) {
        const float t = static_cast<float>(i) / 24.0f;
        const float entasis = 0.175f - 0.035f * t * t + 0.006f * std::sin(kPi * t);
        shaft.emplace_back(entasis, 0.37f + t * 1.80f);
    }
    const Profile profile = {torusRoll(0.215f, 0.13f, 0.22f),
                             line({0.215f, 0.22f}, {0.205f, 0.235f}),
                             profileArc({0.235f, 0.265f}, 0.04f, 228.0f, 132.0f, 6),
                             torusRoll(0.195f, 0.295f, 0.35f),
                             line({0.195f, 0.35f}, {0.19f, 0.37f}),
                             shaft,
                             torusRoll(0.142f, 2.17f, 2.21f),
                             line({0.142f, 2.21f}, {0.142f, 2.29f}),
                             line({0.155f, 2.29f}, {0.155f, 2.31f}),
                             profileArc({0.145f, 2.415f}, 0.105f, -80.0f, 0.0f, 10)};
    append(g, lathe(profile, 40));
    const Profile abacus = {line({0.0f, 2.415f}, {0.25f, 2.415f}), line({0.25f, 2.415f}, {0.25f, 2.485f}),
                            line({0.25f, 2.485f}, {0.275f, 2.50f}), line({0.275f, 2.50f}, {0.275f, kSpringing}),
                            line({0.275f, kSpringing}, {0.0f, kSpringing})};
    append(g, rectangularLathe(abacus, {0.0f, 0.0f}));
    return g;
}

Geometry pier() {
    const float w = 0.5f * kWallThickness + 0.03f;
    const Profile profile = {line({w + 0.06f, 0.0f}, {w + 0.06f, 0.26f}),
                             line({w + 0.06f, 0.26f}, {w, 0.32f}),
                             line({w, 0.32f}, {w, 2.42f}),
                             line({w, 2.42f}, {w + 0.05f, 2.48f}),
                             line({w + 0.05f, 2.48f}, {w + 0.05f, 2.55f}),
                             line({w + 0.05f, 2.55f}, {w, 2.55f}),
                             line({w, 2.55f}, {w, kWallTop}),
                             line({w, kWallTop}, {0.0f, kWallTop})};
    return rectangularLathe(profile, {0.0f, 0.0f});
}

Geometry archWall() {
    const float radius = kArchRadius + 0.06f;
    const float corner = std::atan2(kWallTop - kSpringing, 0.5f * kBay);
    std::vector<float> angles = {corner, kPi - corner};
    for (int i = 0; i <= 32; ++i) angles.push_back(kPi * static_cast<float>(i) / 32.0f);
    std::sort(angles.begin(), angles.end());
    const float z = 0.5f * kWallThickness;
    Geometry g;
    for (size_t i = 0; i + 1 < angles.size(); ++i) {
        const glm::vec2 inner[2] = {onArc(radius, angles[i]), onArc(radius, angles[i + 1])};
        const glm::vec2 outer[2] = {onBayOutline(angles[i]), onBayOutline(angles[i + 1])};
        for (const float side : {1.0f, -1.0f}) {
            const auto base = static_cast<uint32_t>(g.positions.size());
            for (const glm::vec2 p : {inner[0], outer[0], outer[1], inner[1]}) {
                g.positions.emplace_back(p, side * z);
                g.normals.emplace_back(0.0f, 0.0f, side);
                g.uvs.emplace_back(side * p.x, -p.y);
            }
            const bool front = side > 0.0f;
            g.triangles.emplace_back(base, base + (front ? 1 : 2), base + (front ? 2 : 1));
            g.triangles.emplace_back(base, base + (front ? 2 : 3), base + (front ? 3 : 2));
        }
        appendQuad(g, {inner[0], z}, {inner[1], z}, {inner[1], -z}, {inner[0], -z}, {z, angles[i]},
                   {-z, angles[i + 1]});
    }
    return g;
}

Geometry archStones() {
    constexpr int kStones = 15;
    constexpr float kGap = 0.006f;
    Geometry g;
    for (int stone = 0; stone < kStones; ++stone) {
        const bool key = stone == kStones / 2;
        const float outer = kArchRadius + (key ? 0.33f : 0.22f);
        const float inner = kArchRadius - (key ? 0.03f : 0.0f);
        const float from = kPi * static_cast<float>(stone) / kStones + kGap;
        const float to = kPi * static_cast<float>(stone + 1) / kStones - kGap;
        std::vector<glm::vec2> wedge;
        for (int i = 0; i <= 4; ++i) wedge.push_back(onArc(outer, glm::mix(from, to, static_cast<float>(i) / 4.0f)));
        for (int i = 4; i >= 0; --i) wedge.push_back(onArc(inner, glm::mix(from, to, static_cast<float>(i) / 4.0f)));
        const float z = 0.5f * kWallThickness + (key ? 0.055f : 0.03f);
        append(g, extrude(wedge, -z, z, 0.008f));
    }
    return g;
}

Geometry cornice() {
    const float w = 0.5f * kWallThickness;
    const Profile profile = {line({w, kWallTop - 0.16f}, {w + 0.03f, kWallTop - 0.16f}),
                             line({w + 0.03f, kWallTop - 0.16f}, {w + 0.03f, kWallTop - 0.10f}),
                             profileArc({w + 0.13f, kWallTop - 0.10f}, 0.10f, 180.0f, 90.0f, 8),
                             line({w + 0.15f, kWallTop}, {w + 0.15f, kWallTop + 0.05f}),
                             profileArc({w + 0.15f, kWallTop + 0.09f}, 0.04f, -90.0f, 0.0f, 6),
                             line({w + 0.19f, kWallTop + 0.09f}, {w + 0.19f, kWallTop + 0.12f}),
                             line({w + 0.19f, kWallTop + 0.12f}, {-w, kWallTop + 0.12f})};
    return sweepAlongX(profile, kBay);
}

Geometry steps() {
    const float edge = 0.5f * kWallThickness + 0.09f;
    const float nose = 0.015f;
    Profile profile;
    const glm::vec2 treads[2] = {{edge + 0.34f, 0.15f}, {edge, kGalleryFloor}};
    float back = edge + 0.34f;
    for (const glm::vec2 t : treads) {
        const float foot = t.y - 0.15f;
        profile.push_back(line({t.x, foot}, {t.x, t.y - 2.0f * nose}));
        profile.push_back(profileArc({t.x, t.y - nose}, nose, -90.0f, 90.0f, 6));
        back = t.y < kGalleryFloor ? edge : -edge;
        profile.push_back(line({t.x, t.y}, {back, t.y}));
    }
    return sweepAlongX(profile, kBay);
}

Geometry baluster() {
    const Profile profile = {line({0.062f, 0.0f}, {0.062f, 0.05f}),
                             line({0.062f, 0.05f}, {0.040f, 0.065f}),
                             {{0.034f, 0.08f},
                              {0.030f, 0.10f},
                              {0.036f, 0.14f},
                              {0.052f, 0.19f},
                              {0.062f, 0.24f},
                              {0.060f, 0.29f},
                              {0.048f, 0.35f},
                              {0.036f, 0.42f},
                              {0.028f, 0.49f},
                              {0.026f, 0.53f}},
                             profileArc({0.028f, 0.545f}, 0.015f, -90.0f, 90.0f, 6),
                             line({0.026f, 0.56f}, {0.050f, 0.60f}),
                             line({0.062f, 0.60f}, {0.062f, 0.65f})};
    return lathe(profile, 24);
}

Geometry balustradeRails() {
    const float length = kBay - 0.5f;
    Geometry g = box({-0.5f * length, 0.0f, -0.10f}, {0.5f * length, kBalusterFoot, 0.10f});
    const float y = kBalusterFoot + 0.65f;
    const Profile rail = {line({-0.08f, y}, {0.08f, y}),
                          line({0.08f, y}, {0.09f, y + 0.04f}),
                          profileArc({0.09f, y + 0.07f}, 0.03f, -90.0f, 90.0f, 8),
                          line({0.09f, y + 0.10f}, {-0.09f, y + 0.10f}),
                          profileArc({-0.09f, y + 0.07f}, 0.03f, 90.0f, 270.0f, 8),
                          line({-0.09f, y + 0.04f}, {-0.08f, y})};
    append(g, sweepAlongX(rail, length));
    return g;
}

Geometry roofStrip(uint32_t variant) {
    constexpr float kStep = 0.38f;
    constexpr int kTiles = 10;
    Dice dice(200 + variant);
    const glm::mat4 slope = glm::rotate(glm::mat4(1.0f), glm::radians(kRoofPitchDegrees), glm::vec3(1.0f, 0.0f, 0.0f));
    Geometry g;
    for (int i = 0; i < kTiles; ++i) {
        for (const bool cover : {false, true}) {
            const Geometry tile = roofTile(cover, 3.0f * glm::vec2{dice.roll(), dice.roll()});
            const glm::vec3 at{cover ? 0.0f : 0.5f * kRoofStripWidth, 0.014f * dice.roll(),
                               -kStep * static_cast<float>(i) + dice.roll(-0.012f, 0.012f)};
            glm::mat4 pose = glm::translate(slope, at);
            pose = glm::rotate(pose, glm::radians(dice.roll(-1.6f, 1.6f)), glm::vec3(0.0f, 1.0f, 0.0f));
            // Each tile lies on the one below: a little less steep than the roof.
            append(g, tile, glm::rotate(pose, glm::radians(-2.0f), glm::vec3(1.0f, 0.0f, 0.0f)));
        }
    }
    return g;
}

Geometry ceilingBeam() { return box({-0.09f, 0.0f, -0.5f * kGalleryDepth}, {0.09f, 0.2f, 0.5f * kGalleryDepth}); }

}  // namespace raylab::assets
