#include "ui/editor/chart_plot.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "ui/report/chart_output.h"
#include "ui/report/chart_report.h"
#include "ui/report/chart_svg.h"

namespace raylab {
namespace {

constexpr uint32_t kLight = 0xffc8c4c2u;   ///< of the Pareto front
constexpr uint32_t kTarget = 0xff61bdebu;  ///< of the target
constexpr double kLighten = 0.22;          ///< of the way to white

uint32_t channelOf(std::string_view hex, size_t at) {
    uint32_t value = 0;
    std::from_chars(hex.data() + at, hex.data() + at + 2, value, 16);
    return static_cast<uint32_t>(std::lround(value + kLighten * (255.0 - value)));
}

PlotSeries seriesOf(const ChartCurve& curve, size_t index) {
    PlotSeries series{.name = curve.config, .color = plotColor(index), .points = {}};
    for (const ChartGroup& group : curve.groups)
        series.points.push_back({.x = group.deviceSeconds.value,
                                 .y = group.error.value,
                                 .low = group.error.low,
                                 .high = group.error.high,
                                 .ringed = group.pareto});
    return series;
}

PlotSeries frontOf(const std::vector<ChartCurve>& curves) {
    PlotSeries front{.name = "", .color = kLight, .points = {}, .line = PlotLine::dotted, .hasMarkers = false};
    for (const ChartCurve& curve : curves)
        for (const ChartGroup& group : curve.groups)
            if (group.pareto) front.points.push_back({.x = group.deviceSeconds.value, .y = group.error.value});
    std::ranges::sort(front.points, {}, &PlotPoint::x);
    return front;
}

std::string percentText(double part) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g %%", 100.0 * part);
    return text.data();
}

std::string samplesText(double samples) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), samples < 1e6 ? "%.0f" : "%.3g", std::ceil(samples));
    return text.data();
}

/// Of a minute or an hour too.
std::string waitText(double seconds) {
    if (seconds < 100.0) return secondsText(seconds);
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), seconds < 6000.0 ? "%.1f min" : "%.1f h",
                  seconds < 6000.0 ? seconds / 60.0 : seconds / 3600.0);
    return text.data();
}

}  // namespace

uint32_t plotColor(size_t curve) {
    const std::string_view hex = curveColor(curve);
    return channelOf(hex, 1) | channelOf(hex, 3) << 8 | channelOf(hex, 5) << 16 | 0xff000000u;
}

PlotSpec plotOf(const Chart& chart, double targetError, std::optional<size_t> lit) {
    PlotSpec spec{.id = "chart", .xLabel = "time on the device", .yLabel = errorAxisLabel(chart)};
    const RenderSettings& settings = chart.plan.configs.front().settings;
    spec.yLabel += "   " + std::filesystem::path(chart.scene).stem().string() + ", " + std::to_string(settings.width) +
                   " x " + std::to_string(settings.height);
    spec.showX = secondsText;
    spec.showY = shortNumber;
    spec.hasLegend = false;
    for (size_t i = 0; i < chart.curves.size(); ++i) {
        spec.series.push_back(seriesOf(chart.curves[i], i));
        spec.series.back().isDim = lit && *lit != i;
    }
    spec.series.push_back(frontOf(chart.curves));
    if (targetError > 0.0 && chart.plan.measure == ErrorMeasure::relative)
        spec.levels.push_back({targetError, "target " + percentText(targetError), kTarget});
    return spec;
}

std::string costText(const NoiseState& now, double targetError, const ChartCurve* curve) {
    const std::optional<Interval> slope = curve != nullptr ? noiseSlopeOf(*curve) : std::nullopt;
    const std::optional<TargetCost> cost = costOfError(now, targetError, slope.value_or(kNoiseSlope));
    if (!cost) return "The film has no noise to go by yet.";
    if (curve != nullptr && curve->plateau == Plateau::bias && curve->bias.value > targetError)
        return "Never: the bias of these settings is " + percentText(curve->bias.value) + ", by the chart.";
    std::string text = "Now " + percentText(now.relativeError) + " after " + samplesText(now.samples) + " samples. ";
    if (now.relativeError <= targetError) return text + "The target is reached.";
    text += percentText(targetError) + " takes " + samplesText(cost->samples.value) + " samples, " +
            waitText(cost->seconds.value);
    if (!slope) return text + " at a slope of -1/2.";
    std::array<char, 48> by{};
    std::snprintf(by.data(), by.size(), ", by the chart's slope of %.2f", slope->value);
    const bool hasRange = std::isfinite(slope->low) && std::isfinite(slope->high);
    return text + (hasRange ? " (" + waitText(cost->seconds.low) + " to " + waitText(cost->seconds.high) + ")" : "") +
           by.data() + ".";
}

std::string cheapestText(const Chart& chart, double targetError) {
    if (chart.plan.measure != ErrorMeasure::relative) return "";
    std::vector<std::optional<Interval>> times;
    for (const ChartCurve& curve : chart.curves) times.push_back(timeToError(curve, targetError));
    const std::optional<ChartBest> best = bestOf(times);
    if (!best) return "No charted settings were measured to come there.";
    const RenderSettings& s = chart.plan.configs.front().settings;
    std::string text = "Cheapest of the chart: " + chart.curves[best->curve].config + ", " +
                       secondsText(best->value.value) + " at " + std::to_string(s.width) + " x " +
                       std::to_string(s.height);
    for (size_t i = 0; i < best->ties.size(); ++i)
        text += (i == 0 ? "; no slower for certain: " : ", ") + chart.curves[best->ties[i]].config;
    return text + ".";
}

}  // namespace raylab
