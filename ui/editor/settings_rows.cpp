#include "ui/editor/settings_rows.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

#include "ui/editor/theme.h"

namespace raylab {
namespace {

using SettingRow = Setting<RenderSettings>;

bool drawBool(const SettingRow&, bool& value) { return ImGui::Checkbox("##value", &value); }

bool drawInteger(const SettingRow& row, int64_t& value) {
    int64_t edited = value;
    ImGui::InputScalar("##value", ImGuiDataType_S64, &edited, nullptr, nullptr, nullptr,
                       ImGuiInputTextFlags_EnterReturnsTrue);
    if (!ImGui::IsItemDeactivatedAfterEdit()) return false;
    value = std::clamp(edited, static_cast<int64_t>(row.lowest), static_cast<int64_t>(std::min(row.highest, 9e18)));
    return true;
}

bool drawNumber(const SettingRow& row, double& value) {
    const double range = row.highest - row.lowest;
    const float speed = static_cast<float>(range <= 128.0 ? range * 0.002 : std::max(std::abs(value) * 0.01, 0.01));
    if (!ImGui::DragScalar("##value", ImGuiDataType_Double, &value, speed, &row.lowest, &row.highest, "%.4g"))
        return false;
    value = std::clamp(value, row.lowest, row.highest);
    return true;
}

bool drawText(const SettingRow& row, std::string& value) {
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

bool drawValue(const SettingRow& row, bool& value) { return drawBool(row, value); }
bool drawValue(const SettingRow& row, int64_t& value) { return drawInteger(row, value); }
bool drawValue(const SettingRow& row, double& value) { return drawNumber(row, value); }
bool drawValue(const SettingRow& row, std::string& value) { return drawText(row, value); }

void drawHelp(const SettingRow& row, const std::string& standard, const std::string& standardName) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26.0f);
    ImGui::TextUnformatted(std::string(row.help).c_str());
    std::string facts = "--" + std::string(row.name);
    if (!row.unit.empty()) facts += ", " + std::string(row.unit);
    if (!standard.empty()) facts += ", " + standardName + " " + standard;
    ImGui::TextColored(color::kDim, "%s", facts.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

}  // namespace

bool beginSettingsTable(const char* id) {
    if (!ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp)) return false;
    ImGui::TableSetupColumn("name", 0, 0.46f);
    ImGui::TableSetupColumn("value", 0, 0.54f);
    return true;
}

bool drawSettingRow(const Setting<RenderSettings>& row, RenderSettings& settings, const RenderSettings& standards,
                    const char* standardName) {
    const std::string name(row.name);
    const std::string standard = settingText(getSetting(row, standards));
    const bool changed = getSetting(row, settings) != getSetting(row, standards);
    ImGui::PushID(name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(changed ? color::kAccent : color::kText, "%s", name.c_str());
    drawHelp(row, standard, standardName);
    const bool reset = changed && ImGui::IsItemClicked(ImGuiMouseButton_Right);
    if (reset) setSetting(row, settings, standard);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1.0f);
    const bool edited = std::visit([&](auto member) { return drawValue(row, settings.*member); }, row.member);
    ImGui::PopID();
    return reset || edited;
}

}  // namespace raylab
