#include <cmath>
#include <glm/gtc/constants.hpp>

#include "assets/generate/noise.h"
#include "assets/generate/statue_parts.h"

namespace raylab::assets {
namespace {

struct Feather {
    glm::vec3 root;
    glm::vec3 axis;    ///< unit, from root to tip
    glm::vec3 normal;  ///< unit, the side it bends towards
    float length;
    float halfWidth;
    float bend;  ///< how far the tip leaves the straight line, as a share of the length
    uint32_t columns;
    uint32_t rows;
};

/// A solid vane with a shaft and barbs: the cross-section goes once round, front then back.
Geometry makeFeather(const Feather& f) {
    const glm::vec3 axis = glm::normalize(f.axis);
    const glm::vec3 right = glm::normalize(glm::cross(axis, f.normal));
    const glm::vec3 out = glm::cross(right, axis);
    return parametricSurface(f.columns, f.rows, [&](float around, float u) {
        const float angle = glm::two_pi<float>() * (around == 1.0f ? 0.0f : around);
        const float v = -std::cos(angle);
        const float front = -std::sin(angle);
        const float vane = 0.30f + 0.70f * glm::smoothstep(0.0f, 0.35f, u);
        const float ends = glm::min(1.0f, 20.0f * u) * std::sqrt(glm::max(0.0f, 1.0f - std::pow(u, 7.0f)));
        const float outline = vane * ends;
        const float shaft = 0.10f * std::exp(-60.0f * v * v) * (1.0f - 0.8f * u);
        const float barbs = 0.035f * std::sin(1.4f * f.length / f.halfWidth * 22.0f * (u - 0.16f * std::abs(v)));
        const float body = 0.16f * std::sqrt(glm::max(0.0f, 1.0f - v * v)) + shaft + barbs * (1.0f - v * v);
        const float height = f.halfWidth * outline * (front * body - 0.22f * v * v) + f.bend * f.length * u * u;
        return f.root + axis * (f.length * u) + right * (f.halfWidth * outline * v) + out * height;
    });
}

glm::vec3 onBone(const std::vector<glm::vec3>& bone, float s) {
    const float position = glm::clamp(s, 0.0f, 1.0f) * static_cast<float>(bone.size() - 1);
    const auto i = glm::min(static_cast<size_t>(position), bone.size() - 2);
    return glm::mix(bone[i], bone[i + 1], position - static_cast<float>(i));
}

/// One layer of feathers along the bone; all lengths as shares of the flight feathers'.
struct Row {
    uint32_t count;
    float length;
    float halfWidth;
    float lift;   ///< distance from the wing's middle plane, metres; its sign is the side
    float along;  ///< how far down the flight feathers the row starts, as a share of their length
    uint32_t columns;
    uint32_t rows;
};

void appendRow(Geometry& g, const std::vector<glm::vec3>& bone, float side, const Row& row, uint32_t seed) {
    Dice dice(seed);
    for (uint32_t i = 0; i < row.count; ++i) {
        const float s = (static_cast<float>(i) + 0.5f) / static_cast<float>(row.count);
        // From hanging down and back at the shoulder to sweeping up and back at the tip.
        const float fan = glm::mix(-1.20f, 1.02f, std::pow(s, 0.80f)) + dice.roll(-0.02f, 0.02f);
        const glm::vec3 away = glm::normalize(glm::vec3(side * glm::mix(0.45f, 0.85f, s), 0.0f, -1.0f));
        const glm::vec3 axis = std::cos(fan) * away + glm::vec3(0.0f, std::sin(fan), 0.0f);
        const glm::vec3 normal = glm::normalize(glm::cross(axis, glm::cross(glm::vec3(side, 0.15f, 0.55f), axis)));
        const float flight = glm::mix(0.38f, 0.82f, std::pow(s, 1.1f));
        append(g, makeFeather({.root = onBone(bone, s) + normal * row.lift + axis * (row.along * flight),
                               .axis = axis,
                               .normal = normal,
                               .length = flight * row.length * dice.roll(0.95f, 1.05f),
                               .halfWidth = row.halfWidth * glm::mix(0.85f, 1.1f, s),
                               .bend = -0.10f - 0.06f * s,
                               .columns = row.columns,
                               .rows = row.rows}));
    }
}

}  // namespace

std::vector<glm::vec3> wingBone(float side) {
    return {{side * 0.06f, 1.34f, -0.075f},
            {side * 0.24f, 1.46f, -0.22f},
            {side * 0.46f, 1.68f, -0.33f},
            {side * 0.56f, 1.82f, -0.40f}};
}

Geometry wing(float side) {
    const std::vector<glm::vec3> bone = wingBone(side);
    Geometry g;
    appendRow(g, bone, side, {19, 1.00f, 0.058f, 0.0f, 0.0f, 20, 32}, 701);
    for (const float face : {1.0f, -1.0f}) {
        appendRow(g, bone, side, {19, 0.62f, 0.050f, 0.014f * face, 0.0f, 16, 20}, 703);
        appendRow(g, bone, side, {21, 0.42f, 0.042f, 0.025f * face, 0.0f, 12, 14}, 705);
        appendRow(g, bone, side, {23, 0.26f, 0.034f, 0.038f * face, 0.0f, 10, 10}, 707);
        appendRow(g, bone, side, {25, 0.15f, 0.026f, 0.050f * face, 0.0f, 8, 8}, 709);
        appendRow(g, bone, side, {27, 0.10f, 0.020f, 0.056f * face, -0.04f, 8, 6}, 711);
    }
    return g;
}

}  // namespace raylab::assets
