#include <imgui.h>

#include <algorithm>

#include "ui/editor/panel_parts.h"
#include "ui/editor/panels/bvh.h"
#include "ui/editor/theme.h"

namespace raylab {

std::string nodeName(const TreeInspection& trees, const TreeNode& at) {
    const BvhNode& node = trees.node(at);
    if (at.tree == kUpperTree && node.isLeaf()) {
        const uint32_t instance = trees.placements[node.first].instance;
        return instance == shared::kInheritInstance ? "merged meshes" : "instance " + std::to_string(instance);
    }
    return (node.isLeaf() ? "leaf " : "node ") + std::to_string(at.node);
}

namespace {

constexpr float kIndent = 7.0f;
constexpr float kTreeHeight = 240.0f;

struct TreeDrawing {
    BvhState& state;
    const TreeInspection& trees;
    std::vector<TreeNode> toReveal;  ///< these are to be open
};

/// Primitives below a node, and its own part of the cost.
std::string nodeFigures(const TreeInspection& trees, const TreeNode& at) {
    const NodeFacts& fact = trees.fact(at);
    return countText(fact.primitives) + "  " + figureText(100.0 * fact.sahShare) + " %";
}

void drawNodeRow(TreeDrawing& drawing, const TreeNode& at) {
    const TreeInspection& trees = drawing.trees;
    const std::vector<TreeNode> children = trees.children(at);
    const bool isSelected = drawing.state.selected == at;
    ImGuiTreeNodeFlags flags =
        ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_OpenOnDoubleClick | ImGuiTreeNodeFlags_SpanAvailWidth;
    if (children.empty()) flags |= ImGuiTreeNodeFlags_Leaf;
    if (isSelected) flags |= ImGuiTreeNodeFlags_Selected;
    ImGui::PushID(static_cast<int>(at.tree));
    ImGui::PushID(static_cast<int>(at.placement));
    ImGui::PushID(static_cast<int>(at.node));
    const bool isOnTheWay = std::ranges::find(drawing.toReveal, at) != drawing.toReveal.end();
    if (isOnTheWay && !isSelected) ImGui::SetNextItemOpen(true);
    const bool open = ImGui::TreeNodeEx("node", flags, "%s", nodeName(trees, at).c_str());
    if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen()) drawing.state.select(at, false);
    if (isSelected && isOnTheWay) {
        ImGui::SetScrollHereY(0.5f);
        ImGui::SetScrollX(std::max(ImGui::GetCursorPosX() - 2.0f * kIndent, 0.0f));
    }
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("depth %u, %s primitives\nSAH: %s %% of its tree\noverlap with its sibling: %s %%",
                          trees.depth(at), countText(trees.fact(at).primitives).c_str(),
                          figureText(100.0 * trees.fact(at).sahShare).c_str(),
                          figureText(100.0 * trees.fact(at).siblingOverlap).c_str());
    ImGui::SameLine();
    ImGui::TextColored(color::kDim, "%s", nodeFigures(trees, at).c_str());
    if (open) {
        for (const TreeNode& child : children) drawNodeRow(drawing, child);
        ImGui::TreePop();
    }
    ImGui::PopID();
    ImGui::PopID();
    ImGui::PopID();
}

}  // namespace

void drawTreeView(BvhState& state) {
    const TreeInspection& trees = *state.trees();
    TreeDrawing drawing{state, trees, {}};
    if (state.selected && state.revealSelected) drawing.toReveal = pathTo(trees, *state.selected);
    ImGui::BeginChild("tree", {0.0f, kTreeHeight * ImGui::GetFontSize() / 14.0f}, true,
                      ImGuiWindowFlags_HorizontalScrollbar);
    ImGui::PushStyleVar(ImGuiStyleVar_IndentSpacing, kIndent);
    ImGui::PushID(&trees);  // what was opened in other trees is not what is open here
    ImGui::SetNextItemOpen(true, ImGuiCond_Once);
    drawNodeRow(drawing, trees.root());
    ImGui::PopID();
    ImGui::PopStyleVar();
    ImGui::EndChild();
    state.revealSelected = false;
}

}  // namespace raylab
