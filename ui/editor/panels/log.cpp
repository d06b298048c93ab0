#include <imgui.h>

#include <regex>
#include <sstream>

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

/// "FILE:LINE" that a line of the log begins with, as compilers write it; empty where there is none.
std::string sourcePlace(const std::string& text) {
    static const std::regex kPlace(R"(^([^\s:]*/?[^\s:/]+\.\w+:[0-9]+):)");
    std::smatch found;
    return std::regex_search(text, found, kPlace) ? found[1].str() : "";
}

/// A click on a place in a source copies it.
void drawLine(const std::string& text) {
    ImGui::TextWrapped("%s", text.c_str());
    if (!ImGui::IsItemHovered()) return;
    const std::string place = sourcePlace(text);
    if (place.empty()) return;
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    const ImVec2 lo = ImGui::GetItemRectMin(), hi = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddLine({lo.x, hi.y}, hi, ImGui::GetColorU32(ImGuiCol_Text));
    ImGui::SetTooltip("Click: copy %s", place.c_str());
    if (!ImGui::IsItemClicked()) return;
    ImGui::SetClipboardText(place.c_str());
    logInfo("on the clipboard: " + place);
}

void drawEntry(const LogLine& line) {
    ImGui::PushStyleColor(ImGuiCol_Text, colorOf(line.level));
    std::istringstream stream(line.text);
    for (std::string text; std::getline(stream, text);) drawLine(text);
    ImGui::PopStyleColor();
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
        drawEntry(line);
        if (copy) all += line.text + "\n";
    }
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) ImGui::SetScrollHereY(1.0f);
    ImGui::EndChild();
    if (copy) ImGui::SetClipboardText(all.c_str());
}

}  // namespace raylab
