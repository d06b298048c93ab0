#include "ui/editor/panels/bvh.h"

#include <imgui.h>

#include <algorithm>
#include <array>

#include "ui/editor/bvh_overlay.h"
#include "ui/editor/inspection_panels.h"
#include "ui/editor/panel_parts.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

struct ColorInfo {
    const char* name;
    const char* low;
    const char* high;
};

/// In the order of BoxColor; an instance has no scale.
constexpr std::array<ColorInfo, 5> kBoxColors = {{
    {"depth", "", ""},
    {"SAH cost", "0.001 %", "all of the tree"},
    {"sibling overlap", "none", "all of it"},
    {"triangles", "1", "a million"},
    {"instance", "", ""},
}};

uint32_t deepest(const TreeInspection& trees) {
    uint32_t depth = trees.data.upper.depth;
    for (const TreePlacement& placement : trees.placements)
        depth = std::max(depth, placement.rootDepth + trees.bvh(placement.tree).depth);
    return depth;
}

/// What is built, or why nothing is.
void drawStage(BvhState& state) {
    const SceneBuild& build = state.builds[state.shown];
    const std::string busy = state.builds.busyWith();
    if (build.isBuilding && !busy.empty()) {
        ImGui::TextColored(color::kAccent, "%s", busy.c_str());
        ImGui::SameLine();
        if (ImGui::SmallButton("Cancel")) state.builds.cancel();
    } else if (build.isBuilding) {
        ImGui::TextColored(color::kWarning, "The scene has changed");
    } else if (!build.error.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, color::kError);
        ImGui::TextWrapped("%s", build.error.c_str());
        ImGui::PopStyleColor();
        if (ImGui::SmallButton("Build again")) state.builds.again(state.shown);
    } else if (build.trees != nullptr) {
        const std::string text =
            build.config.builder + ", " + build.config.layout + ": SAH " + figureText(build.trees->sah);
        ImGui::TextColored(color::kDim, "%s", text.c_str());
    }
}

void drawColors(BvhState& state) {
    ImGui::SetNextItemWidth(-1.0f);
    if (ImGui::BeginCombo("##color", kBoxColors[static_cast<size_t>(state.color)].name)) {
        for (size_t i = 0; i < kBoxColors.size(); ++i)
            if (ImGui::Selectable(kBoxColors[i].name, static_cast<size_t>(state.color) == i))
                state.color = static_cast<BoxColor>(i);
        ImGui::EndCombo();
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("What the colour of a box means");
    if (state.color == BoxColor::instance) return;
    colorMapCombo("##map", state.map);
    const ColorInfo& info = kBoxColors[static_cast<size_t>(state.color)];
    if (state.color == BoxColor::depth)
        colorBar(state.map, std::to_string(state.filter.depthMin), std::to_string(state.filter.depthMax));
    else
        colorBar(state.map, info.low, info.high);
}

/// How many boxes are drawn, in words.
std::string boxesText(const BvhState& state) {
    const BoxList& list = state.list;
    if (list.trees == nullptr) return "";
    const std::string drawn = countText(list.boxes.size());
    if (list.boxes.size() < kMostBoxes)
        return list.boxes.size() == list.wanted ? "All " + drawn + " boxes"
                                                : drawn + " of " + countText(list.wanted) + " boxes are in view";
    return "The " + drawn + " largest in view, of " + countText(list.wanted) + " boxes";
}

void drawBoxSection(BvhState& state, const TreeInspection& trees) {
    ImGui::Checkbox("Boxes over the picture", &state.showBoxes);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("A click in the picture selects a leaf; F frames what is selected");
    ImGui::Checkbox("leaves only", &state.filter.leavesOnly);
    const std::string depths =
        "depth " + std::to_string(state.filter.depthMin) + " to " + std::to_string(state.filter.depthMax);
    rightText(depths);
    rangeSlider("depth", state.filter.depthMin, state.filter.depthMax, 0, deepest(trees));
    drawColors(state);
    if (state.showBoxes) dimText(boxesText(state));
}

}  // namespace

void drawBvhPanel(EditorContext& context) {
    lookAtTrees(context);
    auto& state = context.states.get<BvhState>();
    if (!context.state.hasScene()) return dimText("No scene.");
    drawStage(state);
    if (state.compares) {
        for (const size_t which : {0u, 1u}) {
            if (which == 1) ImGui::SameLine();
            if (ImGui::RadioButton(which == 0 ? "A, as rendered" : "B", state.shown == which)) state.shown = which;
        }
    }
    const TreeInspection* trees = state.trees();
    if (trees == nullptr || trees->empty()) {
        if (trees != nullptr) dimText("Nothing that a ray could hit.");
        return;
    }
    drawBoxSection(state, *trees);
    if (ImGui::CollapsingHeader("Tree", ImGuiTreeNodeFlags_DefaultOpen)) drawTreeView(state);
    if (ImGui::CollapsingHeader("Figures")) drawTreeFigures(state, *state.builds[state.shown].shownScene);
    if (ImGui::CollapsingHeader("Two builds")) drawTwoBuilds(state);
}

}  // namespace raylab
