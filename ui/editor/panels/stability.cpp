#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "engine/image/image8.h"
#include "ui/editor/evidence_view.h"
#include "ui/editor/panels.h"
#include "ui/editor/places.h"
#include "ui/editor/stability_feed.h"
#include "ui/editor/theme.h"
#include "ui/report/stability_output.h"

namespace raylab {
namespace {

using stability::Row;

constexpr float kListWidth = 236.0f;
constexpr float kPictureWidth = 170.0f;

struct StabilityPanel {
    StabilityOrder order;
    std::string chosen = "S1";  ///< case
    std::shared_ptr<StabilityFeed> feed = std::make_shared<StabilityFeed>();
    std::shared_ptr<const Row> selected;
    std::shared_ptr<const Row> pictured;  ///< row that `picture` is of
    UiImagePtr picture;
};

ImVec4 verdictColor(const Row& row) {
    if (!row.skipped.empty() || !std::isfinite(row.number.limit)) return color::kDim;
    return row.passes() ? color::kGood : row.isDefault ? color::kError : color::kWarning;
}

/// Each id once, by what its first case provokes.
void drawCases(EditorContext& context, StabilityPanel& p, float height) {
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImGui::GetStyleColorVec4(ImGuiCol_FrameBg));
    ImGui::BeginChild("cases", {0.0f, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleColor();
    std::string_view last;
    for (const stability::Case& each : stability::cases()) {
        const std::string id(each.id), provokes(each.provokes);
        if (each.id == last) continue;
        last = each.id;
        if (ImGui::Selectable(("##" + id).c_str(), p.chosen == id)) p.chosen = id;
        notePlace(context, "stability-case-" + id);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", provokes.c_str());
        ImGui::SameLine(0.0f, 0.0f);
        ImGui::TextColored(color::kDim, "%s", id.c_str());
        ImGui::SameLine(40.0f * context.scale);
        ImGui::TextUnformatted(provokes.c_str());
    }
    ImGui::EndChild();
}

void drawOrder(EditorContext& context, StabilityPanel& p, bool running) {
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    ImGui::SetNextItemWidth(half);
    const bool open = ImGui::BeginCombo("##configs", p.order.configs.c_str());
    notePlace(context, "stability-configs");
    if (!open && ImGui::IsItemHovered()) ImGui::SetTooltip("What is compared with the default");
    if (open) {
        for (const std::string& set : stability::configSets()) {
            if (ImGui::Selectable(set.c_str(), set == p.order.configs)) p.order.configs = set;
            notePlace(context, "stability-set-" + set);
        }
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    ImGui::Checkbox("quick", &p.order.quick);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("A tenth of the rays, small images");
    if (running) {
        if (ImGui::Button("Stop", {-1.0f, 0.0f})) context.measuring.cancel();
        notePlace(context, "stability-stop");
        return;
    }
    ImGui::BeginDisabled(!context.measuring.busyWith().empty());
    const bool one = ImGui::Button(("Run " + p.chosen).c_str(), {half, 0.0f});
    notePlace(context, "stability-run");
    ImGui::SameLine();
    const bool all = ImGui::Button("Run all", {half, 0.0f});
    notePlace(context, "stability-run-all");
    ImGui::EndDisabled();
    if (!one && !all) return;
    p.order.ids = one ? std::vector{p.chosen} : std::vector<std::string>{};
    p.selected.reset();
    startStability(context, p.order, p.feed);
}

void drawRow(EditorContext& context, StabilityPanel& p, const std::shared_ptr<const Row>& row, int index) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(index);
    if (ImGui::Selectable("##row", p.selected == row, ImGuiSelectableFlags_SpanAllColumns)) p.selected = row;
    notePlace(context, "stability-row-" + std::to_string(index));
    ImGui::PopID();
    ImGui::SameLine(0.0f, 0.0f);
    ImGui::TextColored(verdictColor(*row), "%s", stabilityVerdict(*row).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row->id.c_str());
    ImGui::TableNextColumn();
    ImGui::TextColored(color::kDim, "%s", row->config.c_str());
    ImGui::TableNextColumn();
    const bool measured = row->skipped.empty();
    if (measured) ImGui::TextUnformatted(stabilityNumber(row->number.value).c_str());
    ImGui::TableNextColumn();
    if (measured && std::isfinite(row->number.limit))
        ImGui::TextColored(color::kDim, "%s", stabilityNumber(row->number.limit).c_str());
    ImGui::TableNextColumn();
    const std::string what =
        measured ? row->number.what + " (" + row->number.unit + ")" : row->provokes + ": " + row->skipped;
    ImGui::TextUnformatted(what.c_str());
}

void drawRows(EditorContext& context, StabilityPanel& p, const StabilityFeed::View& view, const ImVec2& size) {
    if (view.rows.empty()) return;
    constexpr ImGuiTableFlags flags =
        ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_Resizable;
    if (!ImGui::BeginTable("rows", 6, flags, size)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    for (const char* name : {"Verdict", "Case", "Settings", "Number", "Limit"}) ImGui::TableSetupColumn(name);
    ImGui::TableSetupColumn("Of what", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableHeadersRow();
    int index = 0;
    for (const auto& row : view.rows) drawRow(context, p, row, index++);
    ImGui::EndTable();
}

void drawPicture(EditorContext& context, StabilityPanel& p) {
    if (!p.selected->number.picture) return;
    if (p.pictured != p.selected) {
        const Image8 image = encodeSrgb8(*p.selected->number.picture);
        context.images.setTexels(p.picture, image.texels, image.width, image.height);
        p.pictured = p.selected;
    }
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = width * static_cast<float>(p.picture->height) / static_cast<float>(p.picture->width);
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    context.images.draw(*ImGui::GetWindowDrawList(), p.picture, lo, {lo.x + width, lo.y + height}, {0.0f, 0.0f},
                        {1.0f, 1.0f}, true);
    ImGui::Dummy({width, height});
}

/// What there is to see of the selected row.
void drawDetail(EditorContext& context, StabilityPanel& p) {
    const Row& row = *p.selected;
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted((row.id + ": " + row.provokes).c_str());
    if (!row.number.note.empty()) ImGui::TextColored(color::kDim, "%s", row.number.note.c_str());
    if (row.number.evidence) {
        if (ImGui::Button("Show in the viewport", {-1.0f, 0.0f}))
            showEvidence(context, row.id + ", " + row.config, *row.number.evidence);
        notePlace(context, "stability-show");
        const stability::Evidence& evidence = *row.number.evidence;
        if (!evidence.rays.empty()) ImGui::TextColored(color::kDim, "with %zu wrong rays", evidence.rays.size());
        if (!evidence.pixels.empty()) ImGui::TextColored(color::kDim, "with %zu wrong pixels", evidence.pixels.size());
    }
    drawPicture(context, p);
    if (!row.number.evidence && !row.number.picture)
        ImGui::TextColored(color::kDim,
                           row.fails() ? "This case keeps no picture." : "Nothing failed: there is no picture.");
    ImGui::PopTextWrapPos();
}

void drawSummary(const StabilityFeed::View& view, bool running) {
    if (!view.error.empty()) return ImGui::TextColored(color::kError, "%s", view.error.c_str());
    if (running) return ImGui::TextColored(color::kAccent, "Running: the viewport waits.");
    if (view.rows.empty()) return ImGui::TextColored(color::kDim, "Choose a case and run it: its numbers come here.");
    const auto count = [&](auto&& of) { return static_cast<int>(std::ranges::count_if(view.rows, of)); };
    const int failures = count([](const auto& row) { return row->isDefault && row->fails(); });
    ImGui::TextColored(failures > 0 ? color::kError : color::kGood, "%d pass, %d fail, %d of these by default%s",
                       count([](const auto& row) { return row->passes(); }),
                       count([](const auto& row) { return row->fails(); }), failures,
                       view.complete ? "" : "; stopped before the end");
}

}  // namespace

/// Where ray tracing fails: cases to run, and a look at what they find.
void drawStabilityPanel(EditorContext& context) {
    auto& p = context.states.get<StabilityPanel>();
    const StabilityFeed::View view = p.feed->view();
    const bool running = view.running && !context.measuring.busyWith().empty();
    noteValue(context, "stability-rows", static_cast<double>(view.rows.size()));
    noteValue(context, "stability-running", running ? 1.0 : 0.0);
    noteValue(context, "stability-evidence", p.selected != nullptr && p.selected->number.evidence ? 1.0 : 0.0);
    const float below = 2.0f * ImGui::GetFrameHeightWithSpacing();
    ImGui::BeginChild("left", {kListWidth * context.scale, 0.0f});
    drawCases(context, p, std::max(ImGui::GetContentRegionAvail().y - below, below));
    drawOrder(context, p, running);
    ImGui::EndChild();
    ImGui::SameLine();
    const float detail = p.selected != nullptr ? kPictureWidth * context.scale : 0.0f;
    ImGui::BeginChild(
        "middle", {ImGui::GetContentRegionAvail().x - detail - (detail > 0.0f ? 8.0f * context.scale : 0.0f), 0.0f});
    drawSummary(view, running);
    drawRows(context, p, view, {0.0f, 0.0f});
    ImGui::EndChild();
    if (p.selected == nullptr) return;
    ImGui::SameLine();
    ImGui::BeginChild("detail");
    drawDetail(context, p);
    ImGui::EndChild();
}

}  // namespace raylab
