#include <imgui.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "ui/editor/bvh_overlay.h"
#include "ui/editor/inspection_panels.h"
#include "ui/editor/panel_parts.h"
#include "ui/editor/panels/bvh.h"
#include "ui/editor/ray_stepper.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

/// A column and the number that it sorts by.
struct Column {
    const char* name;
    double (*value)(const Bvh& bvh, const std::vector<NodeFacts>& facts, uint32_t node);
};

constexpr std::array<Column, 6> kColumns = {{
    {"Node", [](const Bvh&, const std::vector<NodeFacts>&, uint32_t i) { return static_cast<double>(i); }},
    {"Depth", [](const Bvh&, const std::vector<NodeFacts>& f, uint32_t i) { return static_cast<double>(f[i].depth); }},
    {"Primitives",
     [](const Bvh&, const std::vector<NodeFacts>& f, uint32_t i) { return static_cast<double>(f[i].primitives); }},
    {"SAH, %", [](const Bvh&, const std::vector<NodeFacts>& f, uint32_t i) { return 100.0 * f[i].sahShare; }},
    {"Overlap, %", [](const Bvh&, const std::vector<NodeFacts>& f, uint32_t i) { return 100.0 * f[i].siblingOverlap; }},
    {"Half area",
     [](const Bvh& b, const std::vector<NodeFacts>&, uint32_t i) { return halfAreaDouble(b.nodes[i].bounds); }},
}};

/// What the rows are of, and in which order.
struct NodeOrder {
    std::shared_ptr<const TreeInspection> trees;
    uint32_t tree = 0;
    bool leavesOnly = false;
    size_t column = 3;
    bool descending = true;

    bool operator==(const NodeOrder&) const = default;
};

struct NodeTable {
    NodeOrder order;  ///< of `rows`
    std::vector<uint32_t> rows;
    NodeOrder wanted;
    bool isSorting = false;
};

std::vector<uint32_t> sortNodes(const NodeOrder& order) {
    const Bvh& bvh = order.trees->bvh(order.tree);
    const std::vector<NodeFacts>& facts = order.trees->factsOf(order.tree);
    std::vector<std::pair<double, uint32_t>> keys;
    for (uint32_t i = 0; i < bvh.nodes.size(); ++i) {
        if (order.leavesOnly && !bvh.nodes[i].isLeaf()) continue;
        const double value = kColumns[order.column].value(bvh, facts, i);
        keys.emplace_back(order.descending ? -value : value, i);
    }
    std::ranges::sort(keys);
    std::vector<uint32_t> rows;
    for (const auto& [key, node] : keys) rows.push_back(node);
    return rows;
}

/// Sorts in the background, one order at a time.
void keepRows(BvhState& state, NodeTable& table) {
    if (table.isSorting || table.order == table.wanted) return;
    table.isSorting = true;
    state.builds.quick().start("Sorting nodes", [&table, order = table.wanted](JobControl&) {
        return Background::Finish([&table, order, rows = sortNodes(order)] {
            table.order = order;
            table.rows = rows;
            table.isSorting = false;
        });
    });
}

/// Of the choice: the upper tree, or one of those below it.
std::string treeText(const TreeInspection& trees, uint32_t tree) {
    const std::string nodes = ", " + countText(trees.bvh(tree).nodes.size()) + " nodes";
    return (tree == kUpperTree ? "over instances" : "tree " + std::to_string(tree)) + nodes;
}

void drawTreeChoice(BvhState& state, NodeTable& table) {
    const TreeInspection& trees = *state.trees();
    const auto count = static_cast<uint32_t>(trees.data.trees.size());
    if (table.wanted.tree != kUpperTree) table.wanted.tree = std::min(state.chosenTree, count - 1);
    if (table.wanted.tree == kUpperTree && trees.data.upper.nodes.empty()) table.wanted.tree = 0;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 14.0f);
    if (ImGui::BeginCombo("##tree", treeText(trees, table.wanted.tree).c_str())) {
        if (!trees.data.upper.nodes.empty() && ImGui::Selectable(treeText(trees, kUpperTree).c_str()))
            table.wanted.tree = kUpperTree;
        for (uint32_t tree = 0; tree < count; ++tree)
            if (ImGui::Selectable(treeText(trees, tree).c_str())) table.wanted.tree = state.chosenTree = tree;
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    ImGui::Checkbox("leaves only", &table.wanted.leavesOnly);
}

void readSortOrder(NodeOrder& wanted) {
    ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (specs == nullptr || specs->SpecsCount == 0) return;
    wanted.column = static_cast<size_t>(specs->Specs[0].ColumnIndex);
    wanted.descending = specs->Specs[0].SortDirection == ImGuiSortDirection_Descending;
}

/// Where the first instance that shows the tree has it.
TreeNode placedNode(const TreeInspection& trees, uint32_t tree, uint32_t node) {
    if (tree == kUpperTree) return {tree, node, 0};
    const auto placement = std::ranges::find(trees.placements, tree, &TreePlacement::tree);
    return {tree, node, static_cast<uint32_t>(placement - trees.placements.begin())};
}

void drawRow(BvhState& state, const NodeOrder& order, uint32_t node) {
    const Bvh& bvh = order.trees->bvh(order.tree);
    const std::vector<NodeFacts>& facts = order.trees->factsOf(order.tree);
    const bool isSelected = state.selected && state.selected->tree == order.tree && state.selected->node == node;
    ImGui::TableNextRow();
    for (size_t column = 0; column < kColumns.size(); ++column) {
        ImGui::TableNextColumn();
        if (column > 0) {
            ImGui::TextUnformatted(figureText(kColumns[column].value(bvh, facts, node)).c_str());
            continue;
        }
        const std::string name = (bvh.nodes[node].isLeaf() ? "leaf " : "node ") + std::to_string(node);
        if (ImGui::Selectable(name.c_str(), isSelected, ImGuiSelectableFlags_SpanAllColumns))
            state.select(placedNode(*order.trees, order.tree, node), true);
    }
}

void drawRows(BvhState& state, NodeTable& table) {
    constexpr ImGuiTableFlags flags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_Sortable | ImGuiTableFlags_SizingStretchSame;
    if (!ImGui::BeginTable("nodes", static_cast<int>(kColumns.size()), flags)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    for (size_t i = 0; i < kColumns.size(); ++i)
        ImGui::TableSetupColumn(kColumns[i].name,
                                ImGuiTableColumnFlags_PreferSortDescending |
                                    (i == 3 ? ImGuiTableColumnFlags_DefaultSort : ImGuiTableColumnFlags_None));
    ImGui::TableHeadersRow();
    readSortOrder(table.wanted);
    if (table.order.trees == state.builds[state.shown].trees) {
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(table.rows.size()));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
                drawRow(state, table.order, table.rows[static_cast<size_t>(i)]);
    }
    ImGui::EndTable();
}

}  // namespace

/// All nodes of a tree, sorted by what one wants to know.
void drawNodesPanel(EditorContext& context) {
    lookAtTrees(context);
    auto& state = context.states.get<BvhState>();
    auto& table = context.states.get<NodeTable>();
    if (state.trees() == nullptr || state.trees()->empty()) return dimText("No trees yet.");
    table.wanted.trees = state.builds[state.shown].trees;
    drawTreeChoice(state, table);
    ImGui::SameLine();
    if (ImGui::Button("Export all as CSV")) exportNodes(context);
    keepRows(state, table);
    drawRows(state, table);
}

}  // namespace raylab
