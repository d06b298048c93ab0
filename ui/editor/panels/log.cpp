#include <imgui.h>

#include "ui/editor/panels.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

const ImVec4& colorOf(LogLevel level) {
    switch (level) {
        case LogLevel::error:
            return color::kError;
        case LogLevel::warning:
            return color::kWarning;
        case LogLevel::info:
            break;
    }
    return color::kText;
}

}  // namespace

void drawLogPanel(EditorContext& context) {
    if (ImGui::SmallButton("Clear")) context.log.clear();
    ImGui::SameLine();
    const bool copy = ImGui::SmallButton("Copy all");
    const std::vector<LogLine> lines = context.log.lines();
    std::string all;
    ImGui::BeginChild("lines");
    for (const LogLine& line : lines) {
        ImGui::PushStyleColor(ImGuiCol_Text, colorOf(line.level));
        ImGui::TextWrapped("%s", line.text.c_str());
        ImGui::PopStyleColor();
        if (copy) all += line.text + "\n";
    }
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) ImGui::SetScrollHereY(1.0f);
    ImGui::EndChild();
    if (copy) ImGui::SetClipboardText(all.c_str());
}

}  // namespace raylab
