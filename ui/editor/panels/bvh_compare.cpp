#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/accel/builders.h"
#include "ui/editor/panel_parts.h"
#include "ui/editor/panels/bvh.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr double kSame = 5e-4;  ///< of a difference, that is shown as none

void nameCombo(const char* label, const std::vector<std::string>& names, std::string& value) {
    if (!ImGui::BeginCombo(label, value.c_str())) return;
    for (const std::string& name : names)
        if (ImGui::Selectable(name.c_str(), name == value)) value = name;
    ImGui::EndCombo();
}

MeasuredBuild measuredBuild(const SceneBuild& build) {
    MeasuredBuild measured{build.trees.get(), build.figures.get(), {}, build.walks};
    if (build.trees == nullptr || build.isBuilding) return {};
    const auto& trees = build.trees->data.trees;
    const auto largest = std::ranges::max_element(trees, {}, &PrimitiveTree::slotCount);
    if (largest != trees.end()) measured.epo = build.epo[static_cast<size_t>(largest - trees.begin())];
    return measured;
}

std::string valueText(const std::optional<double>& value) { return value ? figureText(*value) : "..."; }

void drawDifference(const FigurePair& row) {
    const auto difference = row.difference();
    if (!difference) return;
    char text[32];
    const double percent = 100.0 * *difference;
    std::snprintf(text, sizeof(text), std::abs(percent) < 99.5 ? "%+.1f %%" : "%+.0f %%", percent);
    const bool isSame = std::abs(*difference) < kSame;
    ImGui::TextColored(isSame              ? color::kDim
                       : *difference < 0.0 ? color::kGood
                                           : color::kWarning,
                       "%s", isSame ? "same" : text);
}

void drawTableRows(const BvhState& state) {
    if (!ImGui::BeginTable("difference", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    for (const char* title : {"A", "B", "B to A"}) ImGui::TableSetupColumn(title);
    ImGui::TableHeadersRow();
    for (const FigurePair& row : compareBuilds(measuredBuild(state.builds[0]), measuredBuild(state.builds[1]))) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored(color::kDim, "%s", row.name.c_str());
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s%s%s", row.help.c_str(), row.unit.empty() ? "" : ", ", row.unit.c_str());
        for (const auto& value : {row.a, row.b}) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(valueText(value).c_str());
        }
        ImGui::TableNextColumn();
        drawDifference(row);
    }
    ImGui::EndTable();
}

/// Narrow: the panel is.
void drawTable(const BvhState& state) {
    const ImVec2 padding = ImGui::GetStyle().CellPadding;
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {0.5f * padding.x, padding.y});
    drawTableRows(state);
    ImGui::PopStyleVar();
}

}  // namespace

void drawTwoBuilds(BvhState& state) {
    if (ImGui::Checkbox("Compare with a build B", &state.compares)) {
        if (!state.compares) state.shown = 0;
        if (!state.second) state.second = state.builds[0].config;
    }
    if (!state.compares) return dimText("By another builder, leaf size or layout; A is that of the settings.");
    ImGui::PushItemWidth(ImGui::GetContentRegionAvail().x * 0.62f);
    nameCombo("builder", builderNames(), state.second->builder);
    nameCombo("layout", layoutNames(), state.second->layout);
    ImGui::SliderInt("leaf size", &state.second->bvh.maxLeafSize, 1, kMaxLeafSize, "%d", ImGuiSliderFlags_AlwaysClamp);
    ImGui::PopItemWidth();
    drawTable(state);
    if (!state.builds[1].error.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, color::kError);
        ImGui::TextWrapped("B: %s", state.builds[1].error.c_str());
        ImGui::PopStyleColor();
    }
}

}  // namespace raylab
