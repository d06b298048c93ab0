#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <set>

#include "ui/editor/advice_feed.h"
#include "ui/editor/panels.h"
#include "ui/editor/places.h"
#include "ui/editor/target_dial.h"
#include "ui/editor/theme.h"
#include "ui/report/chart_output.h"

namespace raylab {
namespace {

constexpr float kGoalWidth = 236.0f;

struct AdvicePanel {
    std::shared_ptr<AdviceFeed> feed = std::make_shared<AdviceFeed>();
    bool byTime = false;
    double seconds = 5.0;
    int width = 160;
    std::set<std::string, std::less<>> held;  ///< settings that are not searched
    std::string file;

    std::vector<std::string> searched() const {
        std::vector<std::string> names = adviceSettings();
        std::erase_if(names, [this](const std::string& name) { return held.contains(name); });
        return names;
    }
};

/// Which settings are tried: the fewer, the sooner there is an answer.
void drawSearched(EditorContext& context, AdvicePanel& p) {
    const std::vector<std::string> all = adviceSettings();
    const std::vector<std::string> searched = p.searched();
    const std::string text = searched.size() == all.size() ? "all settings"
                             : searched.size() == 1        ? searched.front()
                                                           : std::to_string(searched.size()) + " settings";
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color::kDim, "searching");
    ImGui::SameLine(120.0f * context.scale);
    ImGui::SetNextItemWidth(-1.0f);
    const bool open = ImGui::BeginCombo("##searched", text.c_str(), ImGuiComboFlags_HeightLarge);
    notePlace(context, "advice-searched");
    if (!open) return;
    for (const std::string& name : all) {
        bool tried = !p.held.contains(name);
        // The last one stays: a search of nothing would be one of everything.
        ImGui::BeginDisabled(tried && searched.size() == 1);
        ImGui::Checkbox(name.c_str(), &tried);
        if (tried)
            p.held.erase(name);
        else
            p.held.insert(name);
        notePlace(context, "advice-search-" + name);
        ImGui::EndDisabled();
    }
    ImGui::EndCombo();
}

/// What is asked for. The error is that of the dial in the Chart panel.
void drawGoal(EditorContext& context, AdvicePanel& p, bool running) {
    if (ImGui::RadioButton("an error of", !p.byTime)) p.byTime = false;
    ImGui::SameLine(120.0f * context.scale);
    ImGui::SetNextItemWidth(-1.0f);
    drawTargetSlider(context, "%.2f %%");
    if (ImGui::RadioButton("a time of", p.byTime)) p.byTime = true;
    ImGui::SameLine(120.0f * context.scale);
    constexpr double kLeast = 0.1, kMost = 3600.0;
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::DragScalar("##seconds", ImGuiDataType_Double, &p.seconds, 0.1f, &kLeast, &kMost, "%.1f s",
                      ImGuiSliderFlags_AlwaysClamp);
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(color::kDim, "measured at a width of");
    ImGui::SameLine(160.0f * context.scale);
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::InputInt("##width", &p.width, 0, 0, ImGuiInputTextFlags_AutoSelectAll);
    p.width = std::clamp(p.width, 16, 1920);
    notePlace(context, "advice-width");
    drawSearched(context, p);
    if (running) {
        if (ImGui::Button("Stop", {-1.0f, 0.0f})) context.measuring.cancel();
        notePlace(context, "advice-stop");
        return;
    }
    ImGui::BeginDisabled(!context.state.hasScene() || !context.measuring.busyWith().empty());
    if (ImGui::Button("Find the cheapest settings", {-1.0f, 0.0f}))
        startAdvice(context, {p.byTime ? 0.0 : targetOf(context), p.byTime ? p.seconds : 0.0, p.searched()}, p.width, p.feed);
    notePlace(context, "advice-run");
    ImGui::EndDisabled();
}

void drawStep(const AdviceStep& step) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(color::kDim, "%s", step.setting.c_str());
    ImGui::TableNextColumn();
    const bool changed = step.chosen != step.held;
    ImGui::TextColored(changed ? color::kAccent : color::kText, "%s", step.chosen.c_str());
    ImGui::TableNextColumn();
    const auto chosen = std::ranges::find(step.options, step.chosen, &AdviceOption::value);
    if (changed && chosen != step.options.end())
        ImGui::Text("instead of %s: %s", step.held.c_str(), gainText(chosen->gain).c_str());
    else
        ImGui::TextColored(color::kDim, "%s", keptText(step).c_str());
}

void drawSteps(const Advice& advice) {
    if (!ImGui::BeginTable("steps", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("setting");
    ImGui::TableSetupColumn("value");
    ImGui::TableSetupColumn("gain", ImGuiTableColumnFlags_WidthStretch);
    for (const AdviceStep& step : advice.steps) drawStep(step);
    ImGui::EndTable();
}

void drawUnneeded(const AdviceReport& report) {
    for (const LightShare& light : report.lights)
        if (light.share.value < kNoEffect) ImGui::TextColored(color::kDim, "%s has no effect", light.name.c_str());
    for (const FineTexture& texture : report.textures)
        ImGui::TextColored(color::kDim, "texture %s is finer than the pixels by %s", texture.name.c_str(),
                           shortNumber(texture.texelsPerPixel).c_str());
}

void drawUse(EditorContext& context, AdvicePanel& p, const std::shared_ptr<const AdviceReport>& report) {
    if (ImGui::Button("Adopt")) adoptAdvice(context, *report);
    notePlace(context, "advice-adopt");
    ImGui::SameLine();
    if (ImGui::Button("Save preset")) saveAdvice(context, report, p.file);
    notePlace(context, "advice-save");
    ImGui::SameLine();
    if (p.file.empty()) p.file = context.state.document->file().stem().string() + "-fast.json";
    ImGui::SetNextItemWidth(-1.0f);
    ImGui::InputText("##file", &p.file);
}

void drawReport(EditorContext& context, AdvicePanel& p, const std::shared_ptr<const AdviceReport>& report) {
    const Advice& advice = report->advice;
    drawUse(context, p, report);
    ImGui::Text("Forecast   %s", forecastText(advice.forecast).c_str());
    ImGui::TextColored(color::kDim, "achieved   %s, relative error %s", secondsText(advice.achieved.seconds).c_str(),
                       shortNumber(advice.achieved.relativeError).c_str());
    ImGui::TextColored(color::kDim, "as it was   %s", forecastText(advice.standard).c_str());
    if (advice.isStandard) ImGui::TextWrapped("All of this together would gain nothing: what there was is advised.");
    drawSteps(advice);
    drawUnneeded(*report);
}

}  // namespace

/// The cheapest settings for an error or a time, found by measuring.
void drawAdvicePanel(EditorContext& context) {
    auto& p = context.states.get<AdvicePanel>();
    const AdviceFeed::View view = p.feed->view();
    const bool running = view.running && !context.measuring.busyWith().empty();
    noteValue(context, "advice-running", running ? 1.0 : 0.0);
    noteValue(context, "advice-steps",
              view.report != nullptr ? static_cast<double>(view.report->advice.steps.size()) : 0.0);
    ImGui::BeginChild("goal", {kGoalWidth * context.scale, 0.0f});
    drawGoal(context, p, running);
    ImGui::EndChild();
    ImGui::SameLine();
    ImGui::BeginChild("report");
    if (!view.error.empty())
        ImGui::TextColored(color::kError, "%s", view.error.c_str());
    else if (running)
        ImGui::TextColored(color::kAccent, "The viewport waits: %s", view.doing.c_str());
    else if (view.report != nullptr && context.state.hasScene())
        drawReport(context, p, view.report);
    else
        ImGui::TextColored(color::kDim,
                           "Tries depth, sampler, light choice, tracer and more, each by its measured gain.");
    ImGui::EndChild();
}

}  // namespace raylab
