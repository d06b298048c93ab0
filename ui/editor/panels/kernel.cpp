#include <imgui.h>

#include "ui/editor/panels.h"
#include "ui/editor/theme.h"

namespace raylab {

/// What SceneNeeds kept in the kernel and what it left out, and why.
void drawKernelPanel(EditorContext& context) {
    const RenderStatus& status = context.status;
    if (status.needs.empty()) {
        ImGui::TextColored(color::kDim, "No kernel yet.");
        return;
    }
    if (context.session.updatedBytes() > 0)
        ImGui::TextColored(color::kDim, "The last edit was taken up in place: %.1f KiB uploaded.",
                           static_cast<double>(context.session.updatedBytes()) / 1024.0);
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollY;
    if (!ImGui::BeginTable("needs", 3, flags)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("Feature");
    ImGui::TableSetupColumn("Kernel");
    ImGui::TableSetupColumn("Why", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    for (const Need& need : status.needs) {
        const bool kept = (status.kernelNeeds & need.bit) != 0;
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored(kept ? color::kText : color::kDim, "%s", need.name.c_str());
        ImGui::TableNextColumn();
        ImGui::TextColored(kept ? color::kGood : color::kDim, kept ? "kept" : "left out");
        ImGui::TableNextColumn();
        ImGui::TextColored(
            color::kDim, "%s",
            kept && !need.needed ? "kept: was needed before an edit, or --needs full" : need.reason.c_str());
    }
    ImGui::EndTable();
}

}  // namespace raylab
