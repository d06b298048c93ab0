#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "ui/editor/chart_plot.h"
#include "ui/editor/chart_queue.h"
#include "ui/editor/panels.h"
#include "ui/editor/places.h"
#include "ui/editor/target_dial.h"
#include "ui/editor/theme.h"
#include "ui/report/chart_configs.h"
#include "ui/report/chart_output.h"

namespace raylab {
namespace {

constexpr float kListWidth = 236.0f;
constexpr float kTooltipPicture = 220.0f;

struct ChartPanel {
    ChartQueue queue;
    std::shared_ptr<ChartFeed> feed = std::make_shared<ChartFeed>();
    std::string vary = "depth=1,2,4,8";
    std::string folder;
    std::optional<size_t> lit;  ///< curve whose row the pointer is on
    uint64_t shown = 0;         ///< number of the chart that `answer` is of
    std::string answer;
    UiImagePtr image, heat;  ///< of the hovered point
    std::pair<size_t, uint32_t> pictured{~size_t{0}, 0};
    uint64_t picturedOf = 0;
};

bool isRunning(const EditorContext& context, const ChartView& view) {
    return view.running && !context.measuring.busyWith().empty();
}

/// The curve of that name in what was measured.
std::optional<size_t> curveOf(const ChartView& view, const std::string& name) {
    if (view.chart == nullptr) return std::nullopt;
    const auto& configs = view.chart->plan.configs;
    const auto found = std::ranges::find(configs, name, &ChartConfig::name);
    return found == configs.end() ? std::nullopt : std::optional(static_cast<size_t>(found - configs.begin()));
}

void addConfigs(EditorContext& context, ChartPanel& p, const ChartRequest& request) {
    try {
        addToQueue(p.queue, chartConfigs(context.state.settings(), request, *context.status.deviceDescription,
                                        *context.state.document->rendered()));
    } catch (const Error& error) {
        logError(std::string("chart: ") + error.what());
    }
}

void addCurrent(EditorContext& context, ChartPanel& p) {
    const RenderSettings& settings = context.state.settings();
    addToQueue(p.queue, {{configName(settings), settings}});
}

/// Buttons that fill the queue.
void drawAdding(EditorContext& context, ChartPanel& p) {
    ImGui::BeginDisabled(!context.state.hasScene() || context.status.deviceDescription == nullptr);
    if (ImGui::Button("+ Current")) addCurrent(context, p);
    notePlace(context, "chart-add-current");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Queue the settings as they are now");
    ImGui::SameLine();
    if (ImGui::Button("+ Set")) ImGui::OpenPopup("sets");
    notePlace(context, "chart-add-set");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Queue what a set of raylab chart compares");
    ImGui::SameLine();
    if (ImGui::Button("+ Vary")) ImGui::OpenPopup("vary");
    notePlace(context, "chart-add-vary");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Queue the current settings with every value of one of them");
    ImGui::EndDisabled();
    if (ImGui::BeginPopup("sets")) {
        for (const std::string& name : chartSetNames()) {
            if (!missingForChartSet(name).empty()) continue;
            if (ImGui::Selectable(name.c_str())) addConfigs(context, p, {.sets = {name}, .vary = {}, .file = {}});
            notePlace(context, "chart-set-" + name);
        }
        ImGui::EndPopup();
    }
    if (ImGui::BeginPopup("vary")) {
        ImGui::TextColored(color::kDim, "SETTING=VALUE,VALUE,...");
        ImGui::SetNextItemWidth(240.0f * context.scale);
        const bool entered = ImGui::InputText("##vary", &p.vary,
                                              ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
        notePlace(context, "chart-vary-text");
        ImGui::SameLine();
        const bool added = ImGui::Button("Add");
        notePlace(context, "chart-vary-add");
        if (entered || added) {
            addConfigs(context, p, {.sets = {}, .vary = {p.vary}, .file = {}});
            ImGui::CloseCurrentPopup();
        }
        ImGui::EndPopup();
    }
}

void drawCurveTooltip(const ChartCurve& curve) {
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(curve.config.c_str());
    if (curve.fit && curve.fit->degrees > 0)
        ImGui::TextColored(color::kDim, "slope %.3f \u00b1 %.3f over samples", curve.fit->slope, curve.fit->slopeError);
    const std::string plateau = plateauText(curve);
    if (!plateau.empty()) ImGui::TextColored(color::kWarning, "%s", plateau.c_str());
    ImGui::EndTooltip();
}

/// A row of the queue. False where it is to go.
bool drawConfig(ChartPanel& p, const ChartView& view, size_t index) {
    const ChartConfig& config = p.queue.configs[index];
    const std::optional<size_t> curve = curveOf(view, config.name);
    ImGui::PushID(static_cast<int>(index));
    const float line = ImGui::GetTextLineHeight(), unit = line / 14.0f;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float room = ImGui::GetContentRegionAvail().x;
    ImGui::Selectable("##row", false, ImGuiSelectableFlags_AllowItemOverlap, {room - 24.0f * unit, line});
    if (ImGui::IsItemHovered()) {
        p.lit = curve;
        if (curve && *curve < view.chart->curves.size()) drawCurveTooltip(view.chart->curves[*curve]);
    }
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 centre{at.x + 6.0f * unit, at.y + 0.5f * line};
    if (curve)
        list.AddCircleFilled(centre, 4.5f * unit, plotColor(*curve));
    else
        list.AddCircle(centre, 4.0f * unit, ImGui::GetColorU32(color::kDim));
    list.PushClipRect(at, {at.x + room - 26.0f * unit, at.y + line + 2.0f}, true);
    list.AddText({at.x + 16.0f * unit, at.y}, ImGui::GetColorU32(color::kText), config.name.c_str());
    list.PopClipRect();
    ImGui::SameLine(ImGui::GetCursorPosX() + room - 22.0f * unit);
    const bool keep = !ImGui::SmallButton("x");
    ImGui::PopID();
    return keep;
}

void drawQueue(ChartPanel& p, const ChartView& view, float height) {
    p.lit.reset();
    ImGui::PushStyleColor(ImGuiCol_ChildBg, ImGui::GetStyleColorVec4(ImGuiCol_FrameBg));
    ImGui::BeginChild("queue", {0.0f, height}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
    ImGui::PopStyleColor();
    if (p.queue.configs.empty()) ImGui::TextColored(color::kDim, "Queue what is to be compared.");
    std::optional<size_t> gone;
    for (size_t i = 0; i < p.queue.configs.size(); ++i)
        if (!drawConfig(p, view, i)) gone = i;
    if (gone) p.queue.configs.erase(p.queue.configs.begin() + static_cast<std::ptrdiff_t>(*gone));
    ImGui::EndChild();
}

/// A field with its name in front; two of them fill a row.
template <class Draw>
void drawField(EditorContext& context, const char* name, const char* help, Draw&& draw) {
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color::kDim, "%s", name);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1.0f);
    draw();
    notePlace(context, std::string("chart-") + name);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
}

void drawMeasureCombo(ErrorMeasure& measure) {
    if (!ImGui::BeginCombo("##error", std::string(nameOf(measure)).c_str(), ImGuiComboFlags_NoArrowButton)) return;
    for (const std::string& name : errorMeasureNames())
        if (ImGui::Selectable(name.c_str(), name == nameOf(measure))) measure = parseErrorMeasure(name);
    ImGui::EndCombo();
}

void drawCount(const char* id, int& value, int least, int most) {
    ImGui::InputInt(id, &value, 0, 0, ImGuiInputTextFlags_AutoSelectAll);
    value = std::clamp(value, least, most);
}

void drawNumber(const char* id, double& value, double least, double most, const char* format) {
    ImGui::InputDouble(id, &value, 0.0, 0.0, format, ImGuiInputTextFlags_AutoSelectAll);
    value = std::clamp(value, least, most);
}

void drawPlan(EditorContext& context, ChartQueue& q) {
    if (!ImGui::BeginTable("plan", 4, ImGuiTableFlags_SizingStretchProp)) return;
    for (const float weight : {0.2f, 0.31f, 0.2f, 0.29f}) ImGui::TableSetupColumn("", 0, weight);
    drawField(context, "width", "of the pictures; their height by the aspect of the settings",
              [&] { drawCount("##width", q.width, 16, 1920); });
    drawField(context, "seeds", "renderings of each configuration and number of samples",
              [&] { drawCount("##seeds", q.seeds, 2, 32); });
    drawField(context, "points", "numbers of samples: 1, 2, 4, ...", [&] { drawCount("##levels", q.levels, 1, 16); });
    drawField(context, "limit", "seconds of rendering, shared by all configurations; 0: no limit",
              [&] { drawNumber("##limit", q.seconds, 0.0, 36000.0, "%.0f s"); });
    drawField(context, "error", "what is charted: sqrt(relMSE), RMSE or FLIP", [&] { drawMeasureCombo(q.measure); });
    drawField(context, "truth", "relative error of the reference: path tracing without shortcuts",
              [&] { drawNumber("##reference", q.referenceError, 1e-3, 0.5, "%.3f"); });
    ImGui::EndTable();
}

void drawExport(EditorContext& context, ChartPanel& p) {
    if (!ImGui::BeginPopup("export")) return;
    ImGui::TextColored(color::kDim, "Folder for chart.csv, report.html, ...");
    ImGui::SetNextItemWidth(260.0f * context.scale);
    const bool entered = ImGui::InputText("##folder", &p.folder, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::SameLine();
    const bool pressed = ImGui::Button("Write");
    notePlace(context, "chart-export-write");
    if ((entered || pressed) && !p.folder.empty()) {
        exportChart(context, p.feed, p.folder);
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void drawRun(EditorContext& context, ChartPanel& p, const ChartView& view) {
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    if (isRunning(context, view)) {
        if (ImGui::Button("Stop", {half, 0.0f})) context.measuring.cancel();
        notePlace(context, "chart-stop");
    } else {
        ImGui::BeginDisabled(p.queue.configs.empty() || !context.state.hasScene() ||
                             !context.measuring.busyWith().empty());
        if (ImGui::Button("Measure", {half, 0.0f})) startChart(context, p.queue, targetOf(context), p.feed);
        notePlace(context, "chart-measure");
        ImGui::EndDisabled();
    }
    ImGui::SameLine();
    ImGui::BeginDisabled(view.chart == nullptr || isRunning(context, view));
    if (ImGui::Button("Export...", {half, 0.0f})) {
        if (p.folder.empty()) p.folder = "chart-" + context.state.document->file().stem().string();
        ImGui::OpenPopup("export");
    }
    notePlace(context, "chart-export");
    ImGui::EndDisabled();
    drawExport(context, p);
}

/// The picture of the hovered point beside its error map.
void drawPictures(EditorContext& context, ChartPanel& p, const ChartView& view, size_t curve, uint32_t samples) {
    const ChartFeed::Pictures all = p.feed->pictures();
    const auto found = all.find({curve, samples});
    if (found == all.end()) return;
    const ChartPictures& pictures = *found->second;
    if (p.pictured != found->first || p.picturedOf != view.number) {
        context.images.setTexels(p.image, pictures.image.texels, pictures.image.width, pictures.image.height);
        context.images.setTexels(p.heat, pictures.heat.texels, pictures.heat.width, pictures.heat.height);
        p.pictured = found->first;
        p.picturedOf = view.number;
    }
    const float width = kTooltipPicture * context.scale;
    const float height = width * static_cast<float>(pictures.image.height) / static_cast<float>(pictures.image.width);
    for (const UiImagePtr& image : {p.image, p.heat}) {
        const ImVec2 lo = ImGui::GetCursorScreenPos();
        context.images.draw(*ImGui::GetWindowDrawList(), image, lo, {lo.x + width, lo.y + height}, {0.0f, 0.0f},
                            {1.0f, 1.0f}, true);
        ImGui::Dummy({width, height});
        if (image != p.heat) ImGui::SameLine();
    }
    ImGui::TextColored(color::kDim, "right: squared relative error, 0.0001 (black) to 100 (white)");
}

void drawPointTooltip(EditorContext& context, ChartPanel& p, const ChartView& view, size_t curve, size_t point) {
    const ChartGroup& group = view.chart->curves[curve].groups[point];
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(view.chart->curves[curve].config.c_str());
    ImGui::Text("%u samples   error %s (%s to %s)   %s", group.samples, shortNumber(group.error.value).c_str(),
                shortNumber(group.error.low).c_str(), shortNumber(group.error.high).c_str(),
                secondsText(group.deviceSeconds.value).c_str());
    drawPictures(context, p, view, curve, group.samples);
    ImGui::TextColored(color::kDim,
                       group.pareto ? "on the Pareto front; click: take these settings" : "click: take these settings");
    ImGui::EndTooltip();
}

void adopt(EditorContext& context, const Chart& chart, const PlotPick& pick) {
    const ChartConfig& config = chart.plan.configs[pick.series];
    const RenderSettings settings = adoptedSettings(context.state.settings(), config.settings,
                                                    chart.curves[pick.series].groups[pick.point].samples);
    applyEdit(context, {"Adopt " + config.name, [settings](editor::EditState& state) { state.settings = settings; }});
}

void drawChart(EditorContext& context, ChartPanel& p, const ChartView& view, const ImVec2& size) {
    if (view.chart == nullptr) {
        PlotSpec empty{.id = "chart"};
        empty.empty = isRunning(context, view) ? (view.done > 0.0 ? "Rendering the reference: the viewport waits"
                                                                  : "Preparing: the viewport waits")
                                               : "Queue settings on the left, then Measure";
        drawPlot(empty, size);
        return;
    }
    const PlotSpec spec = plotOf(*view.chart, targetOf(context), p.lit);
    const PlotResult result = drawPlot(spec, size);
    for (size_t i = 0; i < view.chart->curves.size() && i < result.places.size(); ++i)
        for (size_t j = 0; j < result.places[i].size(); ++j)
            notePlace(context, "chart-point-" + std::to_string(i) + "-" + std::to_string(j), result.places[i][j].first,
                      result.places[i][j].second);
    noteValue(context, "chart-hovered", result.hovered ? 1.0 : 0.0);
    if (result.hovered) {
        drawPointTooltip(context, p, view, result.hovered->series, result.hovered->point);
        if (result.clicked) adopt(context, *view.chart, *result.hovered);
    }
}

/// What the chart says, or why it ended.
void drawAnswer(ChartPanel& p, const ChartView& view, bool running) {
    if (!view.error.empty()) return ImGui::TextColored(color::kError, "%s", view.error.c_str());
    if (view.chart == nullptr) return;
    if (p.shown != view.number) {
        p.shown = view.number;
        p.answer = chartAnswer(*view.chart, makeTables(*view.chart));
    }
    ImGui::PushTextWrapPos();
    if (running)
        ImGui::TextColored(color::kAccent, "Measuring, %.0f %%: the viewport waits, so that times mean something.",
                           100.0 * view.done);
    else
        ImGui::TextUnformatted(p.answer.c_str());
    ImGui::PopTextWrapPos();
}

}  // namespace

/// Speed against accuracy of settings that the user queues, on the scene as it is seen.
void drawChartPanel(EditorContext& context) {
    auto& p = context.states.get<ChartPanel>();
    const ChartView view = p.feed->view();
    const ImGuiStyle& style = ImGui::GetStyle();
    const float frame = ImGui::GetFrameHeightWithSpacing();
    noteValue(context, "chart-queued", static_cast<double>(p.queue.configs.size()));
    noteValue(context, "chart-points",
              view.chart != nullptr ? static_cast<double>(view.chart->table.points.size()) : 0.0);
    noteValue(context, "chart-running", isRunning(context, view) ? 1.0 : 0.0);
    ImGui::BeginChild("left", {kListWidth * context.scale, 0.0f});
    drawAdding(context, p);
    const float below = 3.0f * (ImGui::GetFrameHeight() + 2.0f * style.CellPadding.y) + frame + style.ItemSpacing.y;
    drawQueue(p, view, std::max(ImGui::GetContentRegionAvail().y - below, 2.0f * frame));
    drawPlan(context, p.queue);
    drawRun(context, p, view);
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("right", {0.0f, 0.0f}, false, ImGuiWindowFlags_NoScrollbar);
    const float text = 2.0f * ImGui::GetTextLineHeightWithSpacing();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    drawChart(context, p, view,
              {room.x, std::max(room.y - text - targetDialHeight() - 2.0f * style.ItemSpacing.y, 60.0f)});
    ImGui::BeginChild("answer", {0.0f, text});
    drawAnswer(p, view, isRunning(context, view));
    ImGui::EndChild();
    drawTargetDial(context, view.chart.get());
    ImGui::EndChild();
}

}  // namespace raylab
