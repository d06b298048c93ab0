#include "ui/editor/heat_map.h"

#include <imgui.h>

#include <algorithm>
#include <array>

#include "ui/editor/inspection_panels.h"
#include "ui/editor/panel_parts.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

const char* fieldTitle(size_t field) { return kCountFields[field].title.data(); }

void drawFieldChoice(HeatState& heat) {
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##counter", fieldTitle(heat.field))) {
        for (size_t i = 0; i < kCountFields.size(); ++i) {
            if (ImGui::Selectable(fieldTitle(i), heat.field == i)) heat.field = i;
            if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", kCountFields[i].help.data());
        }
        ImGui::EndCombo();
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", kCountFields[heat.field].help.data());
    for (int bounce = 0; bounce <= heat.bounces; ++bounce) {
        if (bounce > 0) ImGui::SameLine();
        const std::string name = bounce == 0 ? "primary" : std::to_string(bounce);
        if (ImGui::RadioButton(name.c_str(), heat.bounce == static_cast<size_t>(bounce)))
            heat.bounce = static_cast<size_t>(bounce);
    }
}

void drawWork(HeatState& heat) {
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.5f);
    if (ImGui::SliderInt("bounces", &heat.bounces, 0, 4, "%d", ImGuiSliderFlags_AlwaysClamp))
        heat.bounce = std::min(heat.bounce, static_cast<size_t>(heat.bounces));
    constexpr std::array<const char*, 3> kNames = {"every pixel", "every 2nd", "every 4th"};
    int chosen = heat.divisor == 1 ? 0 : heat.divisor == 2 ? 1 : 2;
    if (ImGui::Combo("rays", &chosen, kNames.data(), static_cast<int>(kNames.size()))) heat.divisor = 1u << chosen;
    ImGui::PopItemWidth();
}

void drawRange(HeatState& heat) {
    if (ImGui::Checkbox("automatic range", &heat.autoRange) && heat.autoRange) heat.shown.reset();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("From the least count to that which 99 %% of the rays do not exceed");
    const std::string range = countText(heat.lo) + " to " + countText(heat.hi);
    rightText(range);
    if (rangeSlider("range", heat.lo, heat.hi, 0, std::max(heat.summary.most, 1u))) heat.autoRange = false;
    colorMapCombo("##map", heat.map);
    colorBar(heat.map, countText(heat.lo), countText(heat.hi));
}

void drawSummary(const HeatState& heat) {
    if (heat.shown == nullptr) return;
    histogram("counts", heat.histogram, heat.binSize == 1 ? "rays with a count of" : "rays with counts from",
              heat.binSize);
    const CountSummary& s = heat.summary;
    dimText("mean " + figureText(s.mean) + ", median " + countText(s.median) + ", 99 % " + countText(s.high) +
            ", most " + countText(s.most));
    dimText(countText(heat.shown->bounces[heat.shownBounce].counts.size()) + " rays, " + heat.shown->traversal);
}

}  // namespace

/// What the traversal does for each ray, as a map over the picture.
void drawHeatPanel(EditorContext& context) {
    auto& heat = context.states.get<HeatState>();
    if (!context.state.hasScene()) return dimText("No scene.");
    ImGui::Checkbox("Counts over the picture", &heat.show);
    drawFieldChoice(heat);
    drawWork(heat);
    if (heat.counter.isBusy()) ImGui::TextColored(color::kAccent, "Counting ...");
    if (!heat.counter.error().empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, color::kError);
        ImGui::TextWrapped("%s", heat.counter.error().c_str());
        ImGui::PopStyleColor();
    }
    if (!heat.show) return dimText("Counted while it is shown, on a device of its own beside the rendering.");
    if (heat.shown == nullptr) return;
    drawRange(heat);
    drawSummary(heat);
}

}  // namespace raylab
