#include <imgui.h>

#include <algorithm>

#include "ui/editor/panel_parts.h"
#include "ui/editor/panels/bvh.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

std::string treeName(const TreeInspection& trees, const Scene& scene, uint32_t index) {
    const PrimitiveTree& tree = trees.data.trees[index];
    if (tree.merged) return "merged meshes";
    const std::string& name = scene.meshes[tree.mesh].name;
    return name.empty() ? "mesh " + std::to_string(tree.mesh) : name;
}

std::string epoText(const SceneBuild& build, uint32_t tree) {
    if (build.trees->data.trees[tree].slotCount > kMostForEpo) return "too large";
    return build.epo[tree] ? figureText(*build.epo[tree]) : "...";
}

void figureRow(const char* name, const std::string& value, const char* help = nullptr) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(color::kDim, "%s", name);
    if (help != nullptr && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
}

void drawDetails(const SceneBuild& build, uint32_t tree) {
    const TreeFigures& figures = build.figures->trees[tree];
    const BvhQuality& quality = figures.quality;
    if (ImGui::BeginTable("details", 2, ImGuiTableFlags_SizingStretchProp)) {
        figureRow("SAH", figureText(quality.sah), "expected cost of a long ray through the root");
        figureRow("EPO", epoText(build, tree), "end-point overlap: Aila, Karras and Laine, HPG 2013");
        figureRow("sibling overlap", figureText(100.0 * quality.siblingOverlap) + " %");
        figureRow("primitives", countText(figures.references), "references: the builders spatial and auto list some twice");
        figureRow("nodes", countText(quality.nodes));
        figureRow("leaf size", figureText(quality.meanLeafSize) + " on average");
        figureRow("depth", std::to_string(quality.depth));
        figureRow("memory", figureText(static_cast<double>(figures.nodeBytes) / (1 << 20)) + " MiB",
                  "of the nodes in their layout");
        ImGui::EndTable();
    }
    ImGui::TextColored(color::kDim, "leaves by depth");
    histogram("depths", quality.depthHistogram, "leaves at depth");
    ImGui::TextColored(color::kDim, "leaves by size");
    histogram("sizes", quality.leafSizeHistogram, "leaves of size");
}

/// One row a tree; a click shows its details.
void drawTrees(const BvhState& state, const SceneBuild& build, const Scene& scene, uint32_t& chosen) {
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit;
    const auto count = static_cast<int>(build.figures->trees.size());
    const float height = ImGui::GetTextLineHeightWithSpacing() * static_cast<float>(std::min(count, 7) + 1) + 8.0f;
    if (!ImGui::BeginTable("trees", 3, flags, {0.0f, height})) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Mesh", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("SAH");
    ImGui::TableSetupColumn("EPO");
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper;
    clipper.Begin(count);
    while (clipper.Step())
        for (auto i = static_cast<uint32_t>(clipper.DisplayStart); i < static_cast<uint32_t>(clipper.DisplayEnd); ++i) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::PushID(static_cast<int>(i));
            const std::string name = treeName(*state.trees(), scene, i);
            if (ImGui::Selectable(name.c_str(), chosen == i, ImGuiSelectableFlags_SpanAllColumns)) chosen = i;
            ImGui::PopID();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(figureText(build.figures->trees[i].quality.sah).c_str());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(epoText(build, i).c_str());
        }
    ImGui::EndTable();
}

}  // namespace

void drawTreeFigures(BvhState& state, const Scene& scene) {
    const SceneBuild& build = state.builds[state.shown];
    if (build.figures == nullptr) return dimText("being measured ...");
    static constexpr double kMebi = 1 << 20;
    dimText(figureText(static_cast<double>(build.figures->bytes()) / kMebi) + " MiB in all, built in " +
            figureText(1e3 * build.trees->buildSeconds) + " ms");
    uint32_t& chosen = state.chosenTree;
    chosen = std::min(chosen, static_cast<uint32_t>(build.figures->trees.size()) - 1);
    drawTrees(state, build, scene, chosen);
    drawDetails(build, chosen);
}

}  // namespace raylab
