#include "assets/generate/plants.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "assets/generate/architecture.h"
#include "assets/generate/noise.h"

namespace raylab::assets {
namespace {

glm::vec3 randomDirection(Dice& dice) {
    const float y = dice.roll(-1.0f, 1.0f);
    const float angle = dice.roll(0.0f, glm::two_pi<float>());
    const float r = std::sqrt(1.0f - y * y);
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

/// A sprig as two strips of quads, bent along `stem` and folded a little at its middle; its foot at `foot`.
void appendSprig(Geometry& g, glm::vec3 foot, glm::vec3 stem, glm::vec3 facing, float length, float droop) {
    const glm::vec3 along = glm::normalize(stem);
    const glm::vec3 right = glm::normalize(glm::cross(along, facing));
    const glm::vec3 out = glm::cross(right, along);
    Geometry card = parametricSurface(2, 3, [&](float u, float v) {
        const float across = u - 0.5f;
        const glm::vec3 fold = out * (0.25f * std::abs(across));
        const glm::vec3 bend = glm::vec3(0.0f, -droop * v * v, 0.0f);
        return foot + length * (along * v + right * across + fold + bend);
    });
    for (glm::vec2& uv : card.uvs) uv.y = 1.0f - uv.y;
    append(g, card);
}

void appendBranch(Geometry& g, std::initializer_list<glm::vec3> path, float from, float to) {
    std::vector<float> radii;
    for (size_t i = 0; i < path.size(); ++i) {
        radii.push_back(glm::mix(from, to, static_cast<float>(i) / static_cast<float>(path.size() - 1)));
    }
    append(g, tube(std::span(path.begin(), path.size()), radii, 10));
}

}  // namespace

Plant citrusTree(uint32_t seed) {
    Dice dice(seed);
    Plant tree;
    const glm::vec3 crown(0.0f, 1.2f, 0.0f);
    appendBranch(tree.wood, {{0.0f, -0.05f, 0.0f}, {0.02f, 0.25f, 0.01f}, {-0.01f, 0.55f, 0.0f}, {0.01f, 0.85f, 0.0f}},
                 0.038f, 0.026f);
    for (int i = 0; i < 9; ++i) {
        const glm::vec3 d = glm::normalize(randomDirection(dice) + glm::vec3(0.0f, 0.5f, 0.0f));
        const glm::vec3 fork(0.01f, 0.78f + 0.02f * static_cast<float>(i % 4), 0.0f);
        appendBranch(tree.wood, {fork, fork + 0.25f * d + glm::vec3(0.0f, 0.06f, 0.0f), crown + 0.38f * d}, 0.016f,
                     0.004f);
    }
    for (int i = 0; i < 620; ++i) {
        const glm::vec3 d = randomDirection(dice);
        const float lumps = 1.0f + 0.22f * noise3(2.2f * d, seed);
        const float depth = std::sqrt(dice.roll(0.30f, 1.0f));
        const glm::vec3 foot = crown + 0.46f * lumps * depth * d * glm::vec3(1.0f, 0.95f, 1.0f);
        const glm::vec3 stem = d + 0.7f * randomDirection(dice) + glm::vec3(0.0f, 0.25f, 0.0f);
        const glm::vec3 facing = d + 0.6f * randomDirection(dice);
        appendSprig(tree.leaves, foot, stem, facing, dice.roll(0.16f, 0.25f), 0.3f);
    }
    for (int i = 0; i < 22; ++i) {
        const glm::vec3 d = randomDirection(dice);
        const glm::vec3 centre = crown + 0.52f * d * dice.roll(0.9f, 1.1f);
        append(tree.fruit, sphere(dice.roll(0.030f, 0.038f), 20, 12), place(centre));
    }
    return tree;
}

Plant cypress(uint32_t seed) {
    Dice dice(seed);
    Plant tree;
    appendBranch(tree.wood, {{0.0f, -0.02f, 0.0f}, {0.0f, 0.5f, 0.0f}, {0.0f, 0.95f, 0.0f}}, 0.02f, 0.003f);
    for (int i = 0; i < 1700; ++i) {
        const float height = std::pow(dice.roll(), 0.85f);
        const float angle = dice.roll(0.0f, glm::two_pi<float>());
        const glm::vec3 out(std::cos(angle), 0.0f, std::sin(angle));
        const float outline =
            0.105f * std::pow(std::sin(glm::pi<float>() * std::pow(0.06f + 0.92f * height, 0.72f)), 0.8f);
        const float lumps = 1.0f + 0.30f * noise3(glm::vec3(2.0f * out.x, 9.0f * height, 2.0f * out.z), seed);
        const glm::vec3 foot =
            out * outline * lumps * std::sqrt(dice.roll(0.4f, 1.0f)) + glm::vec3(0.0f, 0.02f + 0.93f * height, 0.0f);
        const glm::vec3 stem = glm::vec3(0.0f, 1.0f, 0.0f) + 0.45f * out + 0.25f * randomDirection(dice);
        const glm::vec3 facing = out + 0.5f * randomDirection(dice);
        appendSprig(tree.leaves, foot, stem, facing, dice.roll(0.045f, 0.085f), 0.0f);
    }
    return tree;
}

Plant climber(uint32_t seed) {
    Dice dice(seed);
    Plant vine;
    std::vector<glm::vec3> path;
    std::vector<float> radii;
    for (int i = 0; i <= 60; ++i) {
        const float t = static_cast<float>(i) / 60.0f;
        const float rise = glm::min(t / 0.55f, 1.0f) * (kSpringing + 0.75f);
        const float over = glm::max(t - 0.5f, 0.0f) / 0.5f;
        const float angle = 2.0f * glm::pi<float>() * 2.2f * t;
        const float hug = 0.20f + 0.03f * std::sin(9.0f * t);
        path.emplace_back(hug * std::cos(angle) * (1.0f - over) + 1.5f * kBay * over,
                          rise + 0.35f * std::sin(3.1f * over), 0.27f + hug * 0.4f * std::sin(angle) * (1.0f - over));
        radii.push_back(0.028f - 0.018f * t);
    }
    vine.wood = tube(path, radii, 10);
    for (int i = 0; i < 1500; ++i) {
        const float t = std::pow(dice.roll(), 0.45f);
        const auto k = static_cast<size_t>(t * 60.0f);
        const float bush = 0.10f + 0.55f * glm::smoothstep(0.35f, 0.8f, t) *
                                       (0.6f + 0.4f * noise3(glm::vec3(5.0f * t, 0.0f, 0.0f), seed));
        const float reach = bush * std::sqrt(dice.roll());
        glm::vec3 offset = reach * randomDirection(dice) * glm::vec3(1.2f, 0.65f, 0.5f);
        offset.z = std::abs(offset.z);
        const float hang = 0.7f * glm::smoothstep(0.55f, 0.9f, t) * std::pow(dice.roll(), 2.5f);
        const glm::vec3 foot = path[k] + offset - glm::vec3(0.0f, hang, 0.0f);
        const glm::vec3 stem = offset + glm::vec3(0.0f, 0.12f - 0.5f * hang, 0.12f) + 0.3f * randomDirection(dice);
        const glm::vec3 facing = glm::vec3(0.0f, 0.3f, 1.0f) + 0.9f * randomDirection(dice);
        appendSprig(vine.leaves, foot, stem, facing, dice.roll(0.15f, 0.24f), 0.35f);
    }
    return vine;
}

}  // namespace raylab::assets
