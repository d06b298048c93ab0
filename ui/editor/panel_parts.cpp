#include "ui/editor/panel_parts.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr float kBarHeight = 8.0f;
constexpr float kHistogramHeight = 42.0f;

/// What a pointer at a part 0 .. 1 of the slider moves.
void dragEnd(uint32_t& lo, uint32_t& hi, uint32_t value, bool isLow) {
    if (isLow)
        lo = std::min(value, hi);
    else
        hi = std::max(value, lo);
}

}  // namespace

bool rangeSlider(const char* id, uint32_t& lo, uint32_t& hi, uint32_t lowest, uint32_t highest) {
    const uint32_t range = std::max(highest - lowest, 1u);
    lo = std::clamp(lo, lowest, lowest + range);
    hi = std::clamp(hi, lo, lowest + range);
    const uint32_t loBefore = lo, hiBefore = hi;
    const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFrameHeight(), grab = 0.4f * height;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(id, {std::max(width, 1.0f), height});
    const auto place = [&](uint32_t v) {
        return at.x + grab + (width - 2.0f * grab) * static_cast<float>(v - lowest) / static_cast<float>(range);
    };
    bool* dragsLow = ImGui::GetStateStorage()->GetBoolRef(ImGui::GetID(id));
    const float mouse = ImGui::GetIO().MousePos.x;
    if (ImGui::IsItemActivated())
        *dragsLow = std::abs(mouse - place(lo)) < std::abs(mouse - place(hi)) || (lo == hi && mouse < place(lo));
    if (ImGui::IsItemActive()) {
        const float part = std::clamp((mouse - at.x - grab) / std::max(width - 2.0f * grab, 1.0f), 0.0f, 1.0f);
        dragEnd(lo, hi, lowest + static_cast<uint32_t>(std::lround(part * static_cast<float>(range))), *dragsLow);
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = at.y + 0.5f * height;
    const bool isLit = ImGui::IsItemHovered() || ImGui::IsItemActive();
    list.AddRectFilled({at.x, middle - 3.0f}, {at.x + width, middle + 3.0f}, ImGui::GetColorU32(ImGuiCol_FrameBg),
                       3.0f);
    list.AddRectFilled({place(lo), middle - 3.0f}, {place(hi), middle + 3.0f}, ImGui::GetColorU32(ImGuiCol_SliderGrab));
    for (const uint32_t end : {lo, hi})
        list.AddCircleFilled({place(end), middle}, grab,
                             ImGui::GetColorU32(isLit ? ImGuiCol_SliderGrabActive : ImGuiCol_SliderGrab));
    return lo != loBefore || hi != hiBefore;
}

void colorBar(editor::ColorMap map, const std::string& low, const std::string& high) {
    const float width = ImGui::GetContentRegionAvail().x;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    constexpr int kSteps = 48;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < kSteps; ++i) {
        const float x0 = at.x + std::floor(width * static_cast<float>(i) / kSteps),
                    x1 = at.x + std::floor(width * static_cast<float>(i + 1) / kSteps);
        list.AddRectFilled({x0, at.y}, {x1, at.y + kBarHeight},
                           editor::packColor(editor::mapColor(map, (i + 0.5) / kSteps)));
    }
    ImGui::Dummy({width, kBarHeight});
    ImGui::TextColored(color::kDim, "%s", low.c_str());
    ImGui::SameLine(ImGui::GetCursorPosX() + width - ImGui::CalcTextSize(high.c_str()).x);
    ImGui::TextColored(color::kDim, "%s", high.c_str());
}

bool colorMapCombo(const char* id, editor::ColorMap& map) {
    const std::string shown(editor::kColorMaps[static_cast<size_t>(map)].name);
    ImGui::SetNextItemWidth(-1.0f);
    if (!ImGui::BeginCombo(id, shown.c_str())) return false;
    bool chosen = false;
    for (const editor::ColorMapInfo& info : editor::kColorMaps)
        if (ImGui::Selectable(std::string(info.name).c_str(), info.map == map)) {
            map = info.map;
            chosen = true;
        }
    ImGui::EndCombo();
    return chosen;
}

void histogram(const char* id, std::span<const uint32_t> counts, const char* what, uint32_t step) {
    if (counts.empty()) return;
    const float width = ImGui::GetContentRegionAvail().x, height = kHistogramHeight;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(id, {std::max(width, 1.0f), height});
    const auto most = static_cast<float>(std::max(*std::ranges::max_element(counts), 1u));
    const float pitch = width / static_cast<float>(counts.size());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg), 2.0f);
    const float pointer = (ImGui::GetIO().MousePos.x - at.x) / pitch;
    for (size_t i = 0; i < counts.size(); ++i) {
        const float x = at.x + pitch * static_cast<float>(i),
                    bar = (height - 3.0f) * static_cast<float>(counts[i]) / most;
        const bool isLit = ImGui::IsItemHovered() && static_cast<size_t>(std::max(pointer, 0.0f)) == i;
        if (counts[i] > 0)
            list.AddRectFilled({x, at.y + height - std::max(bar, 1.0f)},
                               {x + std::max(pitch - 1.0f, 1.0f), at.y + height},
                               ImGui::GetColorU32(isLit ? color::kSelection : color::kAccent));
        if (isLit) ImGui::SetTooltip("%s %zu: %s", what, i * step, countText(counts[i]).c_str());
    }
}

void searchField(const char* id, ImGuiTextFilter& filter, const char* hint) {
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::InputTextWithHint(id, hint, filter.InputBuf, IM_ARRAYSIZE(filter.InputBuf))) filter.Build();
}

std::string countText(size_t count) {
    std::string text = std::to_string(count);
    for (size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
    return text;
}

std::string figureText(double value) {
    char text[32];
    if (std::abs(value) >= 999.5) return countText(static_cast<size_t>(std::llround(value)));
    std::snprintf(text, sizeof(text), "%.3g", value);
    return text;
}

void rightText(const std::string& text) {
    ImGui::SameLine();
    const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(room, 0.0f));
    ImGui::TextColored(color::kDim, "%s", text.c_str());
}

void dimText(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, color::kDim);
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
}

}  // namespace raylab
