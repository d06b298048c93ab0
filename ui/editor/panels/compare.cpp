#include "ui/editor/compare.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "ui/editor/panel_parts.h"
#include "ui/editor/panels.h"
#include "ui/editor/plot.h"
#include "ui/editor/settings_rows.h"
#include "ui/editor/theme.h"
#include "ui/editor/time_text.h"

namespace raylab {
namespace {

using Side = Comparison::Side;

/// What the panel remembers.
struct ComparePanel {
    ImGuiTextFilter filter;
    bool onlyDifferences = false;
    std::string referencePath;
};

template <class... Values>
std::string format(const char* pattern, Values... values) {
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), pattern, values...);
    return text.data();
}

void drawModes(EditorContext& context, Comparison& comparison) {
    ImGui::SetNextItemWidth(-1.0f);
    if (!ImGui::BeginCombo("##mode", infoOf(comparison.mode()).name.data(), ImGuiComboFlags_HeightLarge)) return;
    for (const CompareModeInfo& info : compareModes()) {
        if (info.mode == CompareMode::absolute) ImGui::Separator();
        if (ImGui::Selectable(info.name.data(), info.mode == comparison.mode())) comparison.setMode(context, info.mode);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", info.help.data());
    }
    ImGui::EndCombo();
}

void drawButtons(EditorContext& context, Comparison& comparison) {
    const float width = (ImGui::GetContentRegionAvail().x - 2.0f * ImGui::GetStyle().ItemSpacing.x) / 3.0f;
    const auto button = [&](const char* name, const char* help) {
        const bool pressed = ImGui::Button(name, {width, 0.0f});
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
        return pressed;
    };
    if (button("Swap", "A's settings become B's, and B's A's")) comparison.swap(context);
    ImGui::SameLine();
    if (button("Take B's", "The scene's settings become those of B; undo brings them back"))
        comparison.giveToA(context);
    ImGui::SameLine();
    if (button("B as A", "B's settings become those of A")) comparison.copyFromA(context);
}

/// In milliseconds.
std::string perSampleText(const Side& side) {
    const auto interval = side.clock.perSample();
    if (!interval) return "-";
    const double value = 1e3 * interval->value, half = 0.5e3 * (interval->high - interval->low);
    const int digits = half >= 1.0 ? 0 : half >= 0.1 ? 1 : 2;
    return format("%.*f \u00b1 %.*f", digits, value, digits, half);
}

std::string stateText(const RenderStatus& status) {
    switch (status.phase) {
        case RenderPhase::preparing:
            return status.text;
        case RenderPhase::paused:
            return "paused";
        default:
            return format("%u / %u", status.samples, status.samplesWanted);
    }
}

std::string percentText(double part) { return part >= 0.0 ? format("%.3g %%", 100.0 * part) : "-"; }

/// B's over A's: of what costs, less is better.
void drawRatio(const std::optional<double>& a, const std::optional<double>& b) {
    ImGui::TableNextColumn();
    if (!a || !b || !(*a > 0.0) || !(*b > 0.0)) return ImGui::TextColored(color::kDim, "-");
    const double ratio = *b / *a;
    ImGui::TextColored(ratio < 0.98 ? color::kGood : ratio > 1.02 ? color::kWarning : color::kDim, "%.2g", ratio);
}

void drawFigure(const char* name, const std::string& a, const std::string& b) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(color::kDim, "%s", name);
    for (const std::string& text : {a, b}) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(text.c_str());
    }
}

std::optional<double> costOf(const Side& side) {
    const auto interval = side.clock.perSample();
    return interval ? std::optional(interval->value) : std::nullopt;
}

void drawFigures(const Comparison& comparison) {
    if (!ImGui::BeginTable("figures", 4, ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("", 0, 0.30f);
    ImGui::TableSetupColumn("A", 0, 0.28f);
    ImGui::TableSetupColumn("B", 0, 0.28f);
    ImGui::TableSetupColumn("B / A", 0, 0.17f);
    ImGui::TableHeadersRow();
    const Side &a = comparison.side(false), &b = comparison.side(true);
    drawFigure("samples", stateText(a.status), stateText(b.status));
    drawFigure("ms / sample", perSampleText(a), perSampleText(b));
    drawRatio(costOf(a), costOf(b));
    drawFigure("rendering", timeText(a.status.seconds), timeText(b.status.seconds));
    drawFigure("noise", percentText(a.status.relativeError), percentText(b.status.relativeError));
    drawFigure("error", percentText(a.error.value_or(-1.0)), percentText(b.error.value_or(-1.0)));
    drawRatio(a.error, b.error);
    ImGui::EndTable();
    if (!b.status.error.empty()) ImGui::TextColored(color::kError, "B: %s", b.status.error.c_str());
}

void drawReference(EditorContext& context, Comparison& comparison, ComparePanel& panel) {
    const bool grows = comparison.reference() == CompareReference::growing;
    ImGui::TextColored(color::kDim, "errors are against");
    if (ImGui::RadioButton("the better side's mean, growing", grows)) comparison.growReference();
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip(
            "The mean of the side that is less noisy by now, as it grows.\nThat side's own error is its noise.");
    if (ImGui::RadioButton("its mean as it is now, kept", !grows)) comparison.keepReference();
    if (!grows) ImGui::TextColored(color::kDim, "    %s", comparison.referenceName().c_str());
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::InputTextWithHint("##reference", "or an image file of the viewport's size", &panel.referencePath,
                                 ImGuiInputTextFlags_EnterReturnsTrue) &&
        !panel.referencePath.empty())
        comparison.readReference(context, panel.referencePath);
}

std::string secondsText(double seconds) { return format("%g s", seconds); }

/// Of error against seconds of rendering.
void drawChart(const Comparison& comparison) {
    PlotSpec spec;
    spec.id = "error";
    spec.xLabel = "seconds";
    spec.yLabel = "error";
    spec.showX = secondsText;
    spec.showY = percentText;
    spec.empty = "no errors yet: both sides want two samples";
    for (const bool b : {false, true}) {
        PlotSeries series;
        series.name = b ? "B" : "A";
        series.color = ImGui::GetColorU32(b ? color::kAccent : color::kText);
        for (const ErrorPoint& point : comparison.side(b).history)
            series.points.push_back({point.seconds, point.error});
        series.hasMarkers = series.points.size() < 3;
        spec.series.push_back(std::move(series));
    }
    drawPlot(spec, {ImGui::GetContentRegionAvail().x, 0.55f * ImGui::GetContentRegionAvail().x});
}

void drawSettings(const EditorContext& context, Comparison& comparison, ComparePanel& panel) {
    ImGui::TextColored(color::kDim, "B's settings; what differs from A is lit");
    searchField("##filter", panel.filter, "Search the settings");
    ImGui::Checkbox("only what differs", &panel.onlyDifferences);
    if (!beginSettingsTable("settings")) return;
    const RenderSettings& ofA = context.state.settings();
    RenderSettings settings = comparison.settings();
    bool changed = false;
    for (const Setting<RenderSettings>& row : renderSettingsTable()) {
        if (Comparison::isShared(row.name) || !panel.filter.PassFilter(std::string(row.name).c_str())) continue;
        if (panel.onlyDifferences && getSetting(row, settings) == getSetting(row, ofA)) continue;
        changed = drawSettingRow(row, settings, ofA, "A") || changed;
    }
    ImGui::EndTable();
    if (changed) comparison.setSettings(settings);
}

}  // namespace

void drawComparePanel(EditorContext& context) {
    if (!context.state.hasScene()) return ImGui::TextColored(color::kDim, "No scene yet.");
    auto& comparison = context.states.get<Comparison>();
    auto& panel = context.states.get<ComparePanel>();
    drawModes(context, comparison);
    if (!comparison.isOn()) {
        ImGui::TextWrapped("Two full configurations of this view, side by side: choose above how they are shown.");
        return;
    }
    drawButtons(context, comparison);
    drawFigures(comparison);
    if (isDifference(comparison.mode())) ImGui::TextWrapped("%s", comparison.result().figure.c_str());
    drawReference(context, comparison, panel);
    drawChart(comparison);
    ImGui::Separator();
    drawSettings(context, comparison, panel);
}

}  // namespace raylab
