#include <cmath>
#include <glm/gtc/constants.hpp>

#include "assets/generate/noise.h"
#include "assets/generate/textures.h"

namespace raylab::assets {
namespace {

/// One leaf or bract in a sprig; x to the right, y up, both in [0, 1].
struct Leaf {
    glm::vec2 base;
    float degrees;  ///< direction of growth, 0 = right, 90 = up
    float length;
    float halfWidth;
    glm::vec3 colour;
};

/// Where a point lies on a leaf: 0 to 1 from base to tip, -1 to 1 across, and its depth inside the outline.
struct LeafPoint {
    float along;
    float across;
    bool inside;
};

LeafPoint locate(const Leaf& leaf, glm::vec2 p) {
    const float angle = glm::radians(leaf.degrees);
    const glm::vec2 axis(std::cos(angle), std::sin(angle));
    const glm::vec2 d = p - leaf.base;
    const float along = glm::dot(d, axis) / leaf.length;
    if (along <= 0.0f || along >= 1.0f) return {along, 0.0f, false};
    const float halfWidth = leaf.halfWidth * 1.95f * std::pow(along, 0.65f) * std::pow(1.0f - along, 0.75f);
    const float across = (axis.x * d.y - axis.y * d.x) / halfWidth;
    return {along, across, std::abs(across) < 1.0f};
}

glm::vec3 shade(const Leaf& leaf, const LeafPoint& at) {
    const float midrib = 1.0f - glm::smoothstep(0.0f, 0.10f, std::abs(at.across));
    const float sideVeins = 0.5f + 0.5f * std::sin(40.0f * (at.along - 0.25f * std::abs(at.across)));
    const float curl = 1.0f - 0.22f * at.across * at.across + 0.10f * at.across;
    return leaf.colour * curl * (0.93f + 0.07f * sideVeins) * (1.0f + 0.35f * midrib) * (0.85f + 0.25f * at.along);
}

/// Paints leaves in order, later over earlier, over a stem. Outside them the colour is `fill`, so that filtering
/// never mixes in a foreign colour.
SurfaceMaps paintSprig(const std::vector<Leaf>& leaves, float stemTop, glm::vec3 stemColour, glm::vec3 fill) {
    const PaintConfig config{.size = 512, .alpha = true, .relief = false, .roughness = false};
    return paintSurface(config, [&](glm::vec2 uv) {
        const glm::vec2 p(uv.x, 1.0f - uv.y);
        SurfacePoint s{.colour = fill, .alpha = 0.0f};
        const float bend = 0.5f + 0.03f * std::sin(5.0f * p.y);
        if (p.y < stemTop && std::abs(p.x - bend) < 0.012f * (1.3f - p.y)) s = {.colour = stemColour, .alpha = 1.0f};
        for (const Leaf& leaf : leaves) {
            const LeafPoint at = locate(leaf, p);
            if (at.inside) s = {.colour = shade(leaf, at), .alpha = 1.0f};
        }
        return s;
    });
}

glm::vec3 vary(glm::vec3 colour, Dice& dice) {
    const glm::vec3 shift{dice.roll(-0.02f, 0.05f), dice.roll(-0.02f, 0.02f), 0.0f};
    return colour * dice.roll(0.8f, 1.15f) + shift;
}

/// Leaves in alternation up the stem, one at the tip.
std::vector<Leaf> alternating(uint32_t count, float length, float halfWidth, glm::vec3 colour, Dice& dice) {
    std::vector<Leaf> leaves;
    for (uint32_t i = 0; i < count; ++i) {
        const float height = 0.06f + 0.62f * static_cast<float>(i) / static_cast<float>(count);
        const float side = i % 2 == 0 ? -1.0f : 1.0f;
        leaves.push_back({.base = {0.5f + 0.03f * std::sin(5.0f * height), height},
                          .degrees = 90.0f + side * dice.roll(38.0f, 68.0f),
                          .length = length * dice.roll(0.85f, 1.1f),
                          .halfWidth = halfWidth * dice.roll(0.85f, 1.1f),
                          .colour = vary(colour, dice)});
    }
    leaves.push_back({{0.5f, 0.62f}, 90.0f + dice.roll(-8.0f, 8.0f), length, halfWidth, vary(colour, dice)});
    return leaves;
}

}  // namespace

SurfaceMaps paintCitrusSprig() {
    Dice dice(81);
    const glm::vec3 green(0.25f, 0.40f, 0.13f);
    return paintSprig(alternating(11, 0.36f, 0.085f, green, dice), 0.66f, {0.30f, 0.34f, 0.16f}, green);
}

SurfaceMaps paintBougainvilleaSprig() {
    Dice dice(83);
    const glm::vec3 magenta(0.80f, 0.13f, 0.42f);
    std::vector<Leaf> leaves = alternating(5, 0.30f, 0.085f, {0.30f, 0.45f, 0.17f}, dice);
    for (uint32_t cluster = 0; cluster < 9; ++cluster) {
        const glm::vec2 centre{dice.roll(0.20f, 0.80f), dice.roll(0.22f, 0.84f)};
        const float turn = dice.roll(0.0f, 360.0f);
        for (uint32_t i = 0; i < 3; ++i) {
            leaves.push_back({centre, turn + 120.0f * static_cast<float>(i) + dice.roll(-15.0f, 15.0f),
                              dice.roll(0.13f, 0.17f), dice.roll(0.055f, 0.072f), vary(magenta, dice)});
        }
        leaves.push_back({centre - 0.012f, 45.0f, 0.034f, 0.012f, {0.95f, 0.90f, 0.72f}});
    }
    return paintSprig(leaves, 0.7f, {0.36f, 0.30f, 0.18f}, magenta);
}

SurfaceMaps paintCypressSprig() {
    Dice dice(85);
    const glm::vec3 green(0.17f, 0.27f, 0.13f);
    std::vector<Leaf> leaves;
    for (uint32_t i = 0; i < 70; ++i) {
        const float height = 0.04f + 0.74f * static_cast<float>(i) / 70.0f;
        const float spread = (i % 2 == 0 ? -1.0f : 1.0f) * dice.roll(12.0f, 52.0f);
        const float offset = 0.16f * dice.roll(-1.0f, 1.0f) * (1.0f - height);
        leaves.push_back({{0.5f + offset, height}, 90.0f + spread, dice.roll(0.14f, 0.24f), 0.016f, vary(green, dice)});
    }
    return paintSprig(leaves, 0.8f, {0.22f, 0.24f, 0.13f}, green);
}

}  // namespace raylab::assets
