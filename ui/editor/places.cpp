#include "ui/editor/places.h"

#include <imgui.h>

namespace raylab {

void notePlace(EditorContext& context, const std::string& name, float x, float y) {
    context.states.get<Places>().centres[name] = {x, y};
}

void notePlace(EditorContext& context, const std::string& name) {
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    notePlace(context, name, 0.5f * (lo.x + hi.x), 0.5f * (lo.y + hi.y));
}

void noteValue(EditorContext& context, const std::string& name, double value) {
    context.states.get<Places>().values[name] = value;
}

std::optional<std::pair<float, float>> findPlace(EditorContext& context, const std::string& name) {
    const auto& centres = context.states.get<Places>().centres;
    const auto found = centres.find(name);
    return found == centres.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace raylab
