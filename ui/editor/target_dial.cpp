#include "ui/editor/target_dial.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "ui/editor/chart_plot.h"
#include "ui/editor/chart_queue.h"
#include "ui/editor/places.h"
#include "ui/editor/theme.h"

namespace raylab {
namespace {

constexpr double kLeastPercent = 0.05, kMostPercent = 50.0;
/// Samples allowed beyond those that are forecast, so that the error ends the rendering and not their number.
constexpr double kSpareSamples = 2.0;

struct TargetDial {
    double percent = 5.0;
};

NoiseState noiseOf(const RenderStatus& status) {
    return {status.relativeError, static_cast<double>(status.samples), status.seconds};
}

const ChartCurve* curveOfCurrent(const EditorContext& context, const Chart* chart) {
    if (chart == nullptr || chart->plan.measure != ErrorMeasure::relative) return nullptr;
    for (size_t i = 0; i < chart->curves.size(); ++i)
        if (isSameMethod(chart->plan.configs[i].settings, context.state.settings())) return &chart->curves[i];
    return nullptr;
}

void stopThere(EditorContext& context, double error, const ChartCurve* curve) {
    const std::optional<Interval> slope = curve != nullptr ? noiseSlopeOf(*curve) : std::nullopt;
    const std::optional<TargetCost> cost = costOfError(noiseOf(context.status), error, slope.value_or(kNoiseSlope));
    constexpr double kMostSamples = 1e9;
    const double samples = cost ? std::min(kSpareSamples * cost->samples.high, kMostSamples) : 0.0;
    std::array<char, 48> name{};
    std::snprintf(name.data(), name.size(), "Stop at an error of %.3g %%", 100.0 * error);
    applyEdit(context, {name.data(), [error, samples](editor::EditState& state) {
                            state.settings.targetError = error;
                            state.settings.spp = std::max(state.settings.spp, static_cast<int64_t>(std::ceil(samples)));
                        }});
}

}  // namespace

double targetOf(EditorContext& context) { return 0.01 * context.states.get<TargetDial>().percent; }

void drawTargetSlider(EditorContext& context, const char* format) {
    ImGui::SliderScalar("##target", ImGuiDataType_Double, &context.states.get<TargetDial>().percent, &kLeastPercent,
                        &kMostPercent, format, ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    notePlace(context, "target-dial");
    if (ImGui::IsItemHovered())
        ImGui::SetTooltip("Relative error, sqrt(relMSE), of the picture that is good enough. Ctrl + click: type it");
}

float targetDialHeight() { return ImGui::GetFrameHeightWithSpacing() + 2.0f * ImGui::GetTextLineHeightWithSpacing(); }

void drawTargetDial(EditorContext& context, const Chart* chart) {
    const double error = targetOf(context);
    const ChartCurve* curve = context.state.hasScene() ? curveOfCurrent(context, chart) : nullptr;
    ImGui::SetNextItemWidth(std::min(280.0f * context.scale, 0.55f * ImGui::GetContentRegionAvail().x));
    drawTargetSlider(context, "target error  %.2f %%");
    ImGui::SameLine();
    ImGui::BeginDisabled(!context.state.hasScene());
    if (ImGui::Button("Stop there")) stopThere(context, error, curve);
    notePlace(context, "target-stop");
    ImGui::EndDisabled();
    const double set = context.state.settings().targetError;
    if (set > 0.0) {
        ImGui::SameLine();
        ImGui::TextColored(color::kAccent, "stops at %.3g %%", 100.0 * set);
    }
    const std::string cost = costText(noiseOf(context.status), error, curve);
    ImGui::TextColored(color::kDim, "%s", cost.c_str());
    if (chart != nullptr) ImGui::TextColored(color::kDim, "%s", cheapestText(*chart, error).c_str());
}

}  // namespace raylab
