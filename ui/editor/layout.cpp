#include "ui/editor/layout.h"

#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "ui/editor/actions.h"
#include "ui/editor/panels.h"
#include "ui/editor/theme.h"
#include "ui/editor/time_text.h"

namespace raylab {
namespace {

constexpr float kSplitter = 4.0f;
constexpr float kStatusHeight = 24.0f;
constexpr float kSmallestPane = 90.0f;
constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

struct Box {
    float x, y, width, height;
};

const char* paneName(Pane pane) {
    switch (pane) {
        case Pane::left: return "left";
        case Pane::right: return "right";
        case Pane::bottom: return "bottom";
        case Pane::centre: return "centre";
    }
    return "";
}

void beginPane(const char* name, const Box& box, ImGuiWindowFlags flags = 0) {
    ImGui::SetNextWindowPos({box.x, box.y});
    ImGui::SetNextWindowSize({box.width, box.height});
    ImGui::Begin(name, nullptr, kFixed | flags);
}

/// The panels of a pane behind tabs.
void drawTabs(EditorContext& context, Pane pane) {
    if (!ImGui::BeginTabBar(paneName(pane), ImGuiTabBarFlags_FittingPolicyScroll)) return;
    std::string& front = context.config.tabs[paneName(pane)];
    const bool restore = ImGui::GetFrameCount() <= 2;
    for (const Panel& panel : panelTable()) {
        if (panel.pane != pane) continue;
        const std::string name(panel.name);
        const bool choose = context.layoutRequest == name || (restore && front == name);
        if (!ImGui::BeginTabItem(name.c_str(), nullptr, choose ? ImGuiTabItemFlags_SetSelected : 0)) continue;
        if (!restore) front = name;
        ImGui::BeginChild("content", {0.0f, 0.0f}, false);
        panel.draw(context);
        ImGui::EndChild();
        ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
}

/// Of a pane, as its front panel needs it.
float leastHeightOf(const EditorContext& context, Pane pane) {
    const auto front = context.config.tabs.find(paneName(pane));
    if (front == context.config.tabs.end()) return 0.0f;
    const auto panel = std::ranges::find(panelTable(), front->second, &Panel::name);
    return panel == panelTable().end() ? 0.0f : panel->leastHeight;
}

/// Its background is what the frame begins with: filling it again takes lavapipe a fifth of a frame.
void drawTabbedPane(EditorContext& context, Pane pane, const Box& box) {
    beginPane(paneName(pane), box, ImGuiWindowFlags_NoBackground);
    drawTabs(context, pane);
    ImGui::End();
}

void drawViewport(EditorContext& context, const Box& box) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    beginPane("Viewport", box,
              ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    drawViewportPanel(context);
    ImGui::End();
}

/// A line that is dragged across: changes `size` by the pointer's way along the axis, times `sign`. Whether it is held.
bool drawSplitter(const char* name, const Box& box, bool vertical, float sign, float& size, float largest) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
    beginPane(name, box, ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoNav);
    ImGui::InvisibleButton(name, {box.width, box.height});
    const bool active = ImGui::IsItemActive();
    if (active || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        ImGui::GetWindowDrawList()->AddRectFilled({box.x, box.y}, {box.x + box.width, box.y + box.height},
                                                  ImGui::GetColorU32(ImGuiCol_SeparatorHovered));
    }
    if (active) size += sign * (vertical ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y);
    size = std::clamp(size, kSmallestPane, std::max(largest, kSmallestPane));
    ImGui::End();
    ImGui::PopStyleVar(2);
    return active;
}

std::string progressText(const RenderStatus& s) {
    char text[160];
    std::snprintf(text, sizeof(text), "%u / %u samples", s.samples, s.samplesWanted);
    std::string line = text;
    if (s.relativeError >= 0.0) {
        std::snprintf(text, sizeof(text), "   noise %.2f %%", 100.0 * s.relativeError);
        line += text;
    }
    if (s.raysPerSecond > 0.0) {
        std::snprintf(text, sizeof(text), "   %.2f Mrays/s", 1e-6 * s.raysPerSecond);
        line += text;
    }
    if (s.phase == RenderPhase::rendering && s.secondsLeft > 0.0) line += "   " + timeText(s.secondsLeft) + " left";
    if (s.phase == RenderPhase::paused) line += "   paused";
    return line;
}

void drawStatus(EditorContext& context, const Box& box) {
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_MenuBarBg));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10.0f * context.scale, 4.0f * context.scale});
    beginPane("status", box, ImGuiWindowFlags_NoScrollbar);
    const RenderStatus& status = context.status;
    const std::string job = context.background.busyWith();
    if (!job.empty()) {
        ImGui::TextColored(color::kAccent, "%s ...", job.c_str());
        ImGui::SameLine();
        if (ImGui::SmallButton("Cancel##job")) context.background.cancel();
    } else if (const std::string measured = context.measuring.busyWith(); !measured.empty()) {
        ImGui::TextColored(color::kAccent, "%s   the viewport waits", measured.c_str());
        ImGui::SameLine();
        if (ImGui::SmallButton("Cancel##measuring")) context.measuring.cancel();
    } else if (status.phase == RenderPhase::preparing) {
        ImGui::TextColored(color::kAccent, "%s", status.text.c_str());
        ImGui::SameLine();
        if (ImGui::SmallButton("Cancel##build")) context.session.cancel();
    } else if (!status.error.empty()) {
        ImGui::TextColored(color::kError, "%s", status.error.substr(0, status.error.find('\n')).c_str());
    } else if (context.state.hasScene()) {
        ImGui::TextUnformatted(progressText(status).c_str());
        if (!status.recovery.empty()) {
            ImGui::SameLine(0.0f, 16.0f * context.scale);
            ImGui::TextColored(color::kWarning, "%s", status.recovery.c_str());
        }
    } else {
        ImGui::TextColored(color::kDim, "File > Open, or drop a scene on the window");
    }
    const std::string right = status.tracer + "   " + context.state.settings().integrator + "   " +
                              std::to_string(status.width) + " x " + std::to_string(status.height);
    if (status.width > 0) {
        ImGui::SameLine(box.width - ImGui::CalcTextSize(right.c_str()).x - 10.0f * context.scale);
        ImGui::TextColored(color::kDim, "%s", right.c_str());
    }
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

}  // namespace

void drawLayout(EditorContext& context) {
    const float s = context.scale;
    const float top = drawMenuBar(context);
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    EditorConfig& config = context.config;
    const float splitter = kSplitter * s, status = kStatusHeight * s;
    const float height = display.y - top - status;
    const float highest = std::max(0.7f * height / s, kSmallestPane);
    const float usualHeight = std::clamp(config.bottomHeight, kSmallestPane, highest);
    float bottomHeight = std::clamp(leastHeightOf(context, Pane::bottom), usualHeight, highest);
    context.viewLent = (bottomHeight - usualHeight) * s;
    const float left = config.leftWidth * s, right = config.rightWidth * s, bottom = bottomHeight * s;
    const float centreX = left + splitter;
    const float centreWidth = std::max(display.x - left - right - 2.0f * splitter, 50.0f);
    const float viewHeight = std::max(height - bottom - splitter, 50.0f);

    drawTabbedPane(context, Pane::left, {0.0f, top, left, height});
    drawTabbedPane(context, Pane::right, {display.x - right, top, right, height});
    drawTabbedPane(context, Pane::bottom, {centreX, top + viewHeight + splitter, centreWidth, bottom});
    drawViewport(context, {centreX, top, centreWidth, viewHeight});
    drawStatus(context, {0.0f, top + height, display.x, status});

    const float widest = 0.4f * display.x / s;
    drawSplitter("split left", {left, top, splitter, height}, true, 1.0f / s, config.leftWidth, widest);
    drawSplitter("split right", {display.x - right - splitter, top, splitter, height}, true, -1.0f / s, config.rightWidth,
                 widest);
    if (drawSplitter("split bottom", {centreX, top + viewHeight, centreWidth, splitter}, false, -1.0f / s, bottomHeight,
                     highest))
        config.bottomHeight = bottomHeight;
    context.layoutRequest.clear();
    drawKeysOverlay(context);
}

}  // namespace raylab
