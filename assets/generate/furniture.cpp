#include <cmath>

#include "assets/generate/architecture.h"

namespace raylab::assets {
namespace {

constexpr float kDoorHalfWidth = 0.55f;
constexpr float kDoorSpringing = 1.75f;

/// Outline of an arched door, counter-clockwise from the lower left, grown by `margin`.
std::vector<glm::vec2> doorOutline(float margin) {
    const float halfWidth = kDoorHalfWidth + margin;
    std::vector<glm::vec2> outline = {{-halfWidth, 0.0f}, {halfWidth, 0.0f}};
    for (const glm::vec2& p : profileArc({0.0f, kDoorSpringing}, halfWidth, 0.0f, 180.0f, 16)) outline.push_back(p);
    return outline;
}

}  // namespace

Geometry doorLeaf() {
    Geometry g;
    for (int plank = 0; plank < 6; ++plank) {
        const float width = 2.0f * kDoorHalfWidth / 6.0f;
        const float left = -kDoorHalfWidth + width * static_cast<float>(plank);
        const float reach = glm::max(std::abs(left), std::abs(left + width));
        const float crown =
            kDoorSpringing + std::sqrt(glm::max(0.01f, kDoorHalfWidth * kDoorHalfWidth * 1.12f - reach * reach));
        const glm::vec2 corners[4] = {{left + 0.006f, 0.0f},
                                      {left + width - 0.006f, 0.0f},
                                      {left + width - 0.006f, crown},
                                      {left + 0.006f, crown}};
        append(g, extrude(corners, 0.0f, 0.05f, 0.008f));
    }
    for (const float y : {0.35f, 1.55f}) append(g, box({-0.52f, y, 0.04f}, {0.52f, y + 0.12f, 0.075f}));
    return g;
}

Geometry doorFrame() {
    Geometry g;
    const std::vector<glm::vec2> inner = doorOutline(-0.02f);
    const std::vector<glm::vec2> outer = doorOutline(0.17f);
    for (size_t i = 1; i < inner.size(); ++i) {
        const size_t next = (i + 1) % inner.size();
        const glm::vec2 stone[4] = {inner[i], outer[i], outer[next], inner[next]};
        append(g, extrude(stone, 0.0f, 0.13f, 0.006f));
    }
    return g;
}

Geometry poolCurb(glm::vec2 halfExtent) {
    // From inside, over the curb, down to the paving outside.
    const Profile profile = {
        line({0.0f, 0.0f}, {0.0f, 0.30f}),    profileArc({0.02f, 0.30f}, 0.02f, 180.0f, 90.0f, 4),
        line({0.02f, 0.32f}, {0.36f, 0.32f}), profileArc({0.36f, 0.295f}, 0.025f, 90.0f, -90.0f, 8),
        line({0.36f, 0.27f}, {0.33f, 0.27f}), profileArc({0.33f, 0.22f}, 0.05f, 90.0f, 180.0f, 6),
        line({0.28f, 0.22f}, {0.28f, 0.08f}), line({0.28f, 0.08f}, {0.32f, 0.06f}),
        line({0.32f, 0.06f}, {0.32f, 0.0f})};
    // The profile runs from the inside out, the reverse of a solid's: turn it round.
    Profile reversed;
    for (auto stretch = profile.rbegin(); stretch != profile.rend(); ++stretch) {
        reversed.emplace_back(stretch->rbegin(), stretch->rend());
    }
    return rectangularLathe(reversed, halfExtent);
}

Geometry pedestal(float height, float w) {
    const float h = height;
    const Profile profile = {
        line({w + 0.22f, 0.0f}, {w + 0.22f, 0.36f}),  line({w + 0.22f, 0.36f}, {w + 0.16f, 0.38f}),
        line({w + 0.16f, 0.38f}, {w + 0.16f, 0.46f}), profileArc({w + 0.16f, 0.54f}, 0.08f, -90.0f, -180.0f, 8),
        line({w + 0.08f, 0.54f}, {w, 0.58f}),         line({w, 0.58f}, {w, h - 0.20f}),
        line({w, h - 0.20f}, {w + 0.02f, h - 0.18f}), profileArc({w + 0.12f, h - 0.18f}, 0.10f, 180.0f, 90.0f, 8),
        line({w + 0.13f, h - 0.08f}, {w + 0.13f, h}), line({w + 0.13f, h}, {0.0f, h})};
    return rectangularLathe(profile, {0.0f, 0.0f});
}

Geometry stoneTable() {
    const float y = kTableHeight;
    const Profile slab = {line({-0.4f, y - 0.09f}, {-0.02f, y - 0.09f}),
                          profileArc({-0.02f, y - 0.05f}, 0.04f, -90.0f, 0.0f, 6),
                          line({0.02f, y - 0.05f}, {0.02f, y - 0.012f}),
                          profileArc({0.008f, y - 0.012f}, 0.012f, 0.0f, 90.0f, 4), line({0.008f, y}, {-0.4f, y})};
    Geometry g = rectangularLathe(slab, {0.95f, 0.4f});
    // Supports: a scroll in outline, wide at the foot and under the slab.
    const float top = y - 0.09f;
    const std::vector<glm::vec2> outline = {{-0.30f, 0.0f},  {0.30f, 0.0f},   {0.30f, 0.10f},  {0.24f, 0.17f},
                                            {0.17f, 0.24f},  {0.15f, 0.36f},  {0.18f, 0.50f},  {0.28f, 0.62f},
                                            {0.32f, top},    {-0.32f, top},   {-0.28f, 0.62f}, {-0.18f, 0.50f},
                                            {-0.15f, 0.36f}, {-0.17f, 0.24f}, {-0.24f, 0.17f}, {-0.30f, 0.10f}};
    const Geometry support = extrude(outline, -0.09f, 0.09f, 0.012f);
    for (const float x : {-0.62f, 0.62f}) append(g, support, place({x, 0.0f, 0.0f}, 90.0f));
    return g;
}

}  // namespace raylab::assets
