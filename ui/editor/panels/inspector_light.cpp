#include <imgui.h>

#include <algorithm>

#include "ui/editor/model/color_temperature.h"
#include "ui/editor/model/edit_lights.h"
#include "ui/editor/panels/inspector.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

/// Colour and strength apart: the strength is the brightest of red, green and blue.
bool drawIntensity(Light& light) {
    float strength = std::max({light.intensity.x, light.intensity.y, light.intensity.z});
    glm::vec3 tint = strength > 0.0f ? light.intensity / strength : glm::vec3(1.0f);
    bool changed = ImGui::ColorEdit3("colour", &tint.x, ImGuiColorEditFlags_Float);
    const std::string format = std::string("%.3f ") + editor::lightUnit(light.kind);
    changed |= ImGui::DragFloat("intensity", &strength, std::max(0.01f, 0.01f * strength), 0.0f, 1e9f, format.c_str());
    if (changed) light.intensity = tint * strength;
    changed |= ImGui::DragFloat3("r, g, b", &light.intensity.x, std::max(0.01f, 0.01f * strength), 0.0f, 1e9f, "%.3f");
    return changed;
}

struct LightTemperature {
    float kelvin = 6500.0f;
};

/// The colour of a black body. The temperature is not kept: a file holds the colour.
bool drawTemperature(EditorContext& context, Light& light) {
    float& kelvin = context.states.get<LightTemperature>().kelvin;
    const bool changed = ImGui::SliderFloat("temperature", &kelvin, static_cast<float>(editor::kLowestKelvin), 15000.0f,
                                            "%.0f K", ImGuiSliderFlags_Logarithmic);
    inspectorTip("Sets the colour to that of a black body, as bright as it is");
    if (changed) light = editor::withTemperature(light, static_cast<double>(kelvin));
    return changed;
}

bool drawCone(Light& light) {
    float inner = glm::degrees(light.innerConeRadians), outer = glm::degrees(light.outerConeRadians);
    bool changed = ImGui::SliderFloat("inner cone", &inner, 0.0f, 90.0f, "%.1f deg");
    inspectorTip("Half the angle within which it is fully bright");
    changed |= ImGui::SliderFloat("outer cone", &outer, 0.1f, 90.0f, "%.1f deg");
    inspectorTip("Half the angle beyond which it is dark");
    if (!changed) return false;
    light.innerConeRadians = glm::radians(std::min(inner, outer));
    light.outerConeRadians = glm::radians(outer);
    return true;
}

/// Of the shape that its kind has.
bool drawSize(Light& light) {
    switch (light.kind) {
        case LightKind::directional: {
            float degrees = glm::degrees(light.angularRadiusRadians);
            const bool changed = ImGui::DragFloat("angular radius", &degrees, 0.005f, 0.0f, 90.0f, "%.3f deg");
            inspectorTip("Of the disc in the sky that the light comes from; the sun's is .267 degrees");
            light.angularRadiusRadians = glm::radians(degrees);
            return changed;
        }
        case LightKind::sphere:
        case LightKind::disc:
            return ImGui::DragFloat("radius", &light.radius, 0.005f, 1e-4f, 1e6f, "%.4f");
        case LightKind::rectangle:
            return ImGui::DragFloat2("width, height", &light.size.x, 0.005f, 1e-4f, 1e6f, "%.4f");
        case LightKind::point:
        case LightKind::spot:
            return false;
    }
    return false;
}

}  // namespace

void inspectLight(EditorContext& context, uint32_t index) {
    Light light = context.state.scene().lights[index];
    const auto commit = [&](bool isChanged, const char* what) {
        if (isChanged)
            applyEdit(context,
                      editor::setLight(index, light, what, std::string(what) + " of light " + std::to_string(index)));
    };
    commit(editName(light.name), "name");
    int kind = static_cast<int>(light.kind);
    if (ImGui::Combo("kind", &kind, "point\0directional\0spot\0sphere\0disc\0rectangle\0")) {
        light.kind = static_cast<LightKind>(kind);
        commit(true, "kind");
    }
    if (light.kind != LightKind::directional)
        commit(ImGui::DragFloat3("position", &light.position.x, 0.01f), "position");
    if (light.kind != LightKind::point && light.kind != LightKind::sphere) {
        commit(ImGui::DragFloat3("direction", &light.direction.x, 0.005f), "direction");
        inspectorTip("The way the light travels");
    }
    commit(drawIntensity(light), "intensity");
    commit(drawTemperature(context, light), "colour");
    if (light.kind == LightKind::spot) commit(drawCone(light), "cone");
    commit(drawSize(light), "size");
    ImGui::Spacing();
    if (ImGui::Button("Duplicate")) applyEdit(context, editor::duplicateLight(index));
    ImGui::SameLine();
    if (ImGui::Button("Delete")) applyEdit(context, editor::deleteLight(index));
}

}  // namespace raylab
