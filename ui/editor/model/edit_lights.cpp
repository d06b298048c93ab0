#include "ui/editor/model/edit_lights.h"

#include <algorithm>
#include <cmath>

#include "engine/core/luminance.h"
#include "engine/scene/import_mesh.h"
#include "ui/editor/model/color_temperature.h"

namespace raylab::editor {
namespace {

constexpr float kWidestConeRadians = 1.5707963f;
constexpr float kSmallestSize = 1e-4f;  ///< of a light with a shape, scene units

float finite(float value) { return std::isfinite(value) ? value : 0.0f; }

/// With the size that its kind has, and none that it has not: files keep no other.
Light withShape(Light light) {
    const bool isRound = light.kind == LightKind::sphere || light.kind == LightKind::disc;
    light.radius = isRound ? std::max(finite(light.radius), kSmallestSize) : 0.0f;
    const bool isRectangle = light.kind == LightKind::rectangle;
    light.size = isRectangle ? glm::max(glm::vec2(finite(light.size.x), finite(light.size.y)), kSmallestSize) : glm::vec2(0.0f);
    light.angularRadiusRadians =
        light.kind == LightKind::directional ? std::clamp(finite(light.angularRadiusRadians), 0.0f, kWidestConeRadians) : 0.0f;
    const glm::vec3 along = light.tangent - glm::dot(light.tangent, light.direction) * light.direction;
    const glm::vec3 other = std::abs(light.direction.x) < 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const float length = glm::length(along);
    if (isRectangle)
        light.tangent = length > 1e-3f ? along / length : glm::normalize(glm::cross(light.direction, other));
    return light;
}

Light settled(Light light) {
    for (int c = 0; c < 3; ++c) {
        light.position[c] = std::clamp(finite(light.position[c]), -kLargestSceneCoordinate, kLargestSceneCoordinate);
        light.intensity[c] = std::max(finite(light.intensity[c]), 0.0f);
    }
    const float length = glm::length(light.direction);
    light.direction = std::isfinite(length) && length > 0.0f ? light.direction / length : glm::vec3(0.0f, -1.0f, 0.0f);
    light.outerConeRadians = std::clamp(finite(light.outerConeRadians), 1e-3f, kWidestConeRadians);
    light.innerConeRadians = std::clamp(finite(light.innerConeRadians), 0.0f, light.outerConeRadians);
    return withShape(light);
}

void selectLight(EditState& state, size_t index) {
    state.selection = {};
    state.selection.light = static_cast<uint32_t>(index);
}

}  // namespace

Edit addLight(Light light) {
    return {std::string("Add ") + lightKindName(light.kind) + " light",
            [light = settled(std::move(light))](EditState& state) {
                state.scene.lights.push_back(light);
                selectLight(state, state.scene.lights.size() - 1);
            }};
}

Edit setLight(uint32_t index, Light light, const std::string& what, std::string mergeKey) {
    return {"Change " + what + " of light",
            [index, light = settled(std::move(light))](EditState& state) { state.scene.lights[index] = light; },
            std::move(mergeKey)};
}

Edit duplicateLight(uint32_t index) {
    return {"Duplicate light", [index](EditState& state) {
                Light copy = state.scene.lights[index];
                copy.name += " copy";
                state.scene.lights.push_back(std::move(copy));
                selectLight(state, state.scene.lights.size() - 1);
            }};
}

Edit deleteLight(uint32_t index) {
    return {"Delete light", [index](EditState& state) {
                state.scene.lights.erase(state.scene.lights.begin() + index);
                state.selection.light.reset();
            }};
}

Light withTemperature(Light light, double kelvin) {
    light.intensity = blackbodyColor(kelvin) * static_cast<float>(luminance(light.intensity));
    return light;
}

const char* lightKindName(LightKind kind) {
    switch (kind) {
        case LightKind::point:
            return "point";
        case LightKind::directional:
            return "directional";
        case LightKind::spot:
            return "spot";
        case LightKind::sphere:
            return "sphere";
        case LightKind::disc:
            return "disc";
        case LightKind::rectangle:
            return "rectangle";
    }
    return "";
}

const char* lightUnit(LightKind kind) { return kind == LightKind::directional ? "W/m2" : "W/sr"; }

}  // namespace raylab::editor
