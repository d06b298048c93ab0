#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "ui/editor/actions.h"
#include "ui/editor/panels.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

/// What the pointer and held keys do; the rest is in the table of actions.
constexpr std::array<std::pair<const char*, const char*>, 12> kMovements = {{
    {"W A S D", "fly ahead, left, back, right"},
    {"Q / E", "fly down / up"},
    {"Shift", "fly faster"},
    {"Right drag", "look around"},
    {"Right drag + wheel", "speed of flight"},
    {"Middle or Alt+left drag", "orbit about the pivot"},
    {"Shift + middle drag", "pan"},
    {"Wheel", "nearer to the pivot, or further"},
    {"Click", "select"},
    {"Double click", "set the pivot"},
    {"Drop", "open a scene, or a sky (.hdr, .exr)"},
    {"Shift + drop", "merge a scene into this one"},
}};

/// Two cells: a key, and what it does. Empty where there is nothing more on this side.
void cells(const std::string& key, const std::string& what) {
    ImGui::TableNextColumn();
    ImGui::TextColored(color::kAccent, "%s", key.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(what.c_str());
}

std::vector<const Action*> actionsWithKeys() {
    std::vector<const Action*> actions;
    for (const Action& action : actionTable())
        if (action.key != 0) actions.push_back(&action);
    return actions;
}

/// Actions in two columns, movements beside them.
void drawTable() {
    const std::vector<const Action*> actions = actionsWithKeys();
    const size_t half = (actions.size() + 1) / 2;
    if (!ImGui::BeginTable("keys", 6, ImGuiTableFlags_SizingFixedFit)) return;
    const auto action = [&](size_t i, size_t end) {
        const bool there = i < std::min(end, actions.size());
        cells(there ? keyText(actions[i]->key, actions[i]->mods) : "",
              there ? std::string(actions[i]->name) + "   " : "");
    };
    for (size_t i = 0; i < std::max(half, kMovements.size()); ++i) {
        ImGui::TableNextRow();
        const bool moves = i < kMovements.size();
        cells(moves ? kMovements[i].first : "", moves ? std::string(kMovements[i].second) + "   " : "");
        action(i, half);
        action(i + half, i < half ? actions.size() : 0);
    }
    ImGui::EndTable();
}

}  // namespace

void drawKeysOverlay(EditorContext& context) {
    if (!context.showKeys) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowFocus();
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize |
                                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                                       ImGuiWindowFlags_NoSavedSettings;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    if (ImGui::Begin("Keys", &context.showKeys, flags)) drawTable();
    ImGui::End();
    ImGui::PopStyleVar();
    if (context.input.pressed(GLFW_KEY_ESCAPE)) context.showKeys = false;
}

}  // namespace raylab
