#include "assets/generate/landscape.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "assets/generate/architecture.h"
#include "assets/generate/noise.h"

namespace raylab::assets {

Geometry hills() {
    return parametricSurface(160, 60, [](float u, float v) {
        const float angle = -glm::two_pi<float>() * u;
        const float radius = 9.0f * std::pow(30.0f, v);
        const glm::vec2 p = radius * glm::vec2(std::cos(angle), std::sin(angle));
        const float wave =
            noise3(glm::vec3(p.x, 0.0f, p.y) / 55.0f, 401) + 0.5f * noise3(glm::vec3(p.x, 9.0f, p.y) / 23.0f, 402);
        const float rise =
            20.0f * glm::smoothstep(30.0f, 260.0f, radius) - 3.0f * glm::smoothstep(12.0f, 40.0f, radius);
        const float height = -0.1f + rise + 8.0f * wave * glm::smoothstep(25.0f, 150.0f, radius);
        return glm::vec3(p.x, height, p.y);
    });
}

Geometry towerWalls() {
    const float w = 0.5f * kBay + 0.5f * kWallThickness;
    const float top = kBelfryFloor + kWallTop;
    const Profile shaft = {{{w + 0.1f, 0.0f}, {w, kBelfryFloor - 0.3f}},
                           {{w, kBelfryFloor - 0.3f}, {w + 0.14f, kBelfryFloor - 0.18f}},
                           {{w + 0.14f, kBelfryFloor - 0.18f}, {w + 0.14f, kBelfryFloor}},
                           {{w + 0.14f, kBelfryFloor}, {0.0f, kBelfryFloor}}};
    const Profile crown = {{{0.0f, top - 0.05f}, {w + 0.16f, top - 0.05f}},
                           {{w + 0.16f, top - 0.05f}, {w + 0.24f, top + 0.10f}},
                           {{w + 0.24f, top + 0.10f}, {0.0f, top + 0.10f}}};
    Geometry g = rectangularLathe(shaft, {0.0f, 0.0f});
    append(g, rectangularLathe(crown, {0.0f, 0.0f}));
    return g;
}

Geometry towerRoof() {
    const float w = 0.5f * kBay + 0.5f * kWallThickness;
    const float eave = kBelfryFloor + kWallTop + 0.10f;
    return rectangularLathe({{{0.0f, eave}, {w + 0.36f, eave}}, {{w + 0.36f, eave}, {0.0f, eave + 1.15f}}},
                            {0.0f, 0.0f});
}

}  // namespace raylab::assets
