#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "ui/editor/panels.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

using Row = Setting<RenderSettings>;

struct SettingsSearch {
    ImGuiTextFilter filter;
};

bool drawBool(const Row&, bool& value) { return ImGui::Checkbox("##value", &value); }

bool drawInteger(const Row& row, int64_t& value) {
    int64_t edited = value;
    ImGui::InputScalar("##value", ImGuiDataType_S64, &edited, nullptr, nullptr, nullptr,
                       ImGuiInputTextFlags_EnterReturnsTrue);
    if (!ImGui::IsItemDeactivatedAfterEdit()) return false;
    value = std::clamp(edited, static_cast<int64_t>(row.lowest), static_cast<int64_t>(std::min(row.highest, 9e18)));
    return true;
}

bool drawNumber(const Row& row, double& value) {
    const double range = row.highest - row.lowest;
    const float speed = static_cast<float>(range <= 128.0 ? range * 0.002 : std::max(std::abs(value) * 0.01, 0.01));
    if (!ImGui::DragScalar("##value", ImGuiDataType_Double, &value, speed, &row.lowest, &row.highest, "%.4g"))
        return false;
    value = std::clamp(value, row.lowest, row.highest);
    return true;
}

bool drawText(const Row& row, std::string& value) {
    if (row.choices.empty()) {
        ImGui::InputText("##value", &value, ImGuiInputTextFlags_EnterReturnsTrue);
        return ImGui::IsItemDeactivatedAfterEdit();
    }
    if (!ImGui::BeginCombo("##value", value.c_str())) return false;
    bool changed = false;
    for (const std::string& choice : row.choices)
        if (ImGui::Selectable(choice.c_str(), choice == value)) {
            changed = choice != value;
            value = choice;
        }
    ImGui::EndCombo();
    return changed;
}

bool drawValue(const Row& row, bool& value) { return drawBool(row, value); }
bool drawValue(const Row& row, int64_t& value) { return drawInteger(row, value); }
bool drawValue(const Row& row, double& value) { return drawNumber(row, value); }
bool drawValue(const Row& row, std::string& value) { return drawText(row, value); }

void drawHelp(const Row& row, const std::string& standard) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26.0f);
    ImGui::TextUnformatted(std::string(row.help).c_str());
    std::string facts = "--" + std::string(row.name);
    if (!row.unit.empty()) facts += ", " + std::string(row.unit);
    if (!standard.empty()) facts += ", default " + standard;
    ImGui::TextColored(color::kDim, "%s", facts.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

/// A row of the table; a value that is not the default is lit, and a right click on its name resets it. True where
/// `settings` has changed.
bool drawSetting(const Row& row, RenderSettings& settings) {
    static const RenderSettings kStandard;
    const std::string name(row.name);
    const std::string standard = settingText(getSetting(row, kStandard));
    const bool changed = getSetting(row, settings) != getSetting(row, kStandard);
    ImGui::PushID(name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(changed ? color::kAccent : color::kText, "%s", name.c_str());
    drawHelp(row, standard);
    const bool reset = changed && ImGui::IsItemClicked(ImGuiMouseButton_Right);
    if (reset) setSetting(row, settings, standard);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1.0f);
    const bool edited = std::visit([&](auto member) { return drawValue(row, settings.*member); }, row.member);
    ImGui::PopID();
    return reset || edited;
}

void drawRow(EditorContext& context, const Row& row) {
    RenderSettings settings = context.state.settings();
    if (!drawSetting(row, settings)) return;
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
    if (!ImGui::BeginTable("figures", 2)) return;
    figure("samples", "%.0f", s.samples);
    if (s.relativeError >= 0.0) figure("noise", "%.3f %%", 100.0 * s.relativeError);
    figure("rays", "%.2f M/s", 1e-6 * s.raysPerSecond);
    figure("rendering", "%.1f s", s.seconds);
    figure("time left", "%.1f s", s.secondsLeft);
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
    filter.Draw("##filter", -1.0f);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Search the settings");
    if (!ImGui::BeginTable("settings", 2, ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("name", 0, 0.46f);
    ImGui::TableSetupColumn("value", 0, 0.54f);
    for (const Row& row : renderSettingsTable())
        if (filter.PassFilter(std::string(row.name).c_str())) drawRow(context, row);
    ImGui::EndTable();
}

}  // namespace raylab
