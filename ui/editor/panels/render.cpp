#include <imgui.h>

#include "ui/editor/panel_parts.h"
#include "ui/editor/panels.h"
#include "ui/editor/settings_rows.h"
#include "ui/editor/theme.h"
#include "ui/editor/time_text.h"

namespace raylab {
namespace {

using SettingRow = Setting<RenderSettings>;

struct SettingsSearch {
    ImGuiTextFilter filter;
};

void drawRow(EditorContext& context, const SettingRow& row) {
    RenderSettings settings = context.state.settings();
    if (!drawSettingRow(row, settings, RenderSettings{}, "default")) return;
    const std::string name(row.name);
    if (context.state.hasScene())
        applyEdit(context, {"Set " + name, [settings](editor::EditState& state) { state.settings = settings; },
                            "setting " + name});
    else
        context.state.startSettings = settings;
}

void drawFigures(const RenderStatus& s) {
    const auto figure = [](const char* name, const char* format, double value) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored(color::kDim, "%s", name);
        ImGui::TableNextColumn();
        ImGui::Text(format, value);
    };
    const auto text = [](const char* name, const std::string& value) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored(color::kDim, "%s", name);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(value.c_str());
    };
    if (!ImGui::BeginTable("figures", 2)) return;
    figure("samples", "%.0f", s.samples);
    if (s.relativeError >= 0.0) figure("noise", "%.3f %%", 100.0 * s.relativeError);
    figure("rays", "%.2f M/s", 1e-6 * s.raysPerSecond);
    text("rendering", timeText(s.seconds));
    text("time left", timeText(s.secondsLeft));
    figure("build", "%.2f s", s.buildSeconds);
    figure("upload", "%.2f s", s.uploadSeconds);
    figure("compile", "%.2f s", s.compileSeconds);
    figure("memory", "%.1f MiB", static_cast<double>(s.sceneBytes + s.traceBytes + s.filmBytes) / (1 << 20));
    ImGui::EndTable();
}

}  // namespace

void drawRenderPanel(EditorContext& context) {
    ImGuiTextFilter& filter = context.states.get<SettingsSearch>().filter;
    ImGui::TextColored(color::kDim, "%s", context.status.device.c_str());
    drawFigures(context.status);
    ImGui::Separator();
    searchField("##filter", filter, "Search the settings");
    if (!beginSettingsTable("settings")) return;
    for (const SettingRow& row : renderSettingsTable())
        if (filter.PassFilter(std::string(row.name).c_str())) drawRow(context, row);
    ImGui::EndTable();
}

}  // namespace raylab
