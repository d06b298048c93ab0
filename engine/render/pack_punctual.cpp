#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/render/gpu_data.h"

namespace raylab {
namespace {

shared::PunctualData placed(const Light& light, uint32_t kind) {
    shared::PunctualData data{};
    data.kind = kind;
    data.position = light.position;
    data.direction = light.direction;
    data.intensity = light.intensity;
    return data;
}

shared::PunctualData packSpot(const Light& light) {
    shared::PunctualData data = placed(light, shared::kPunctualSpot);
    const float cosOuter = std::cos(light.outerConeRadians);
    data.shape.x = 1.0f / std::max(0.001f, std::cos(light.innerConeRadians) - cosOuter);
    data.shape.y = -cosOuter * data.shape.x;
    return data;
}

shared::PunctualData packDirectional(const Light& light) {
    if (light.angularRadiusRadians <= 0.0f) return placed(light, shared::kPunctualDirectional);
    shared::PunctualData data = placed(light, shared::kPunctualSunDisc);
    const float halfSine = std::sin(0.5f * light.angularRadiusRadians), sine = std::sin(light.angularRadiusRadians);
    data.shape.x = 2.0f * halfSine * halfSine;
    data.intensity /= std::numbers::pi_v<float> * sine * sine;
    return data;
}

/// Sphere or disc.
shared::PunctualData packRound(const Light& light, uint32_t kind) {
    shared::PunctualData data = placed(light, kind);
    data.shape.x = light.radius;
    data.intensity /= std::numbers::pi_v<float> * light.radius * light.radius;
    return data;
}

shared::PunctualData packRectangle(const Light& light) {
    shared::PunctualData data = placed(light, shared::kPunctualRectangle);
    data.direction = light.size.x * light.tangent;
    data.shape = light.size.y * glm::cross(light.direction, light.tangent);
    data.position = light.position - 0.5f * (data.direction + data.shape);
    data.intensity /= light.size.x * light.size.y;
    return data;
}

}  // namespace

shared::PunctualData packLight(const Light& light) {
    switch (light.kind) {
        case LightKind::spot:
            return packSpot(light);
        case LightKind::directional:
            return packDirectional(light);
        case LightKind::sphere:
            return packRound(light, shared::kPunctualSphere);
        case LightKind::disc:
            return packRound(light, shared::kPunctualDisc);
        case LightKind::rectangle:
            return packRectangle(light);
        case LightKind::point:
            break;
    }
    return placed(light, shared::kPunctualPoint);
}

shared::PunctualData packAsPoint(const Light& light) {
    if (light.kind == LightKind::spot) return packSpot(light);
    if (light.kind == LightKind::directional) return placed(light, shared::kPunctualDirectional);
    const bool isFlat = light.kind == LightKind::disc || light.kind == LightKind::rectangle;
    return placed(light, isFlat ? shared::kPunctualLambert : shared::kPunctualPoint);
}

}  // namespace raylab
