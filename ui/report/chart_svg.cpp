#include "ui/report/chart_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "engine/measure/log_axis.h"
#include "ui/report/chart_output.h"
#include "ui/report/svg_text.h"

namespace raylab {
namespace {

constexpr std::array<std::string_view, 7> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#56b4e9", "#e69f00", "#7f7f7f"};
/// After as many curves as there are colours the lines change.
constexpr std::array<const char*, 4> kDashes = {"", "7 3", "2 3", "9 3 2 3"};

constexpr double kLeft = 76.0, kTop = 62.0, kPlotWidth = 560.0, kPlotHeight = 380.0, kBottom = 58.0;
constexpr double kLegendX = kLeft + kPlotWidth + 22.0, kLegendWidth = 262.0, kLegendLine = 34.0;
constexpr double kWidth = kLegendX + kLegendWidth;

/// Without variables, which many drawing programs do not know.
constexpr const char* kStyle = R"(<style>
.chart { font: 13px system-ui, -apple-system, "Segoe UI", "Liberation Sans", sans-serif; }
.chart text { fill: #1c1e21; } .chart .soft { fill: #5d636b; } .chart .small { font-size: 11.5px; }
.chart .title { font-size: 16px; font-weight: 600; } .chart .paper { fill: #ffffff; }
.chart .grid { stroke: #d0d5db; } .chart .minor { stroke: #eceff2; } .chart .frame { fill: none; stroke: #5d636b; }
.chart .front { fill: none; stroke: #1c1e21; stroke-width: 1.3; stroke-dasharray: 1 4; stroke-linecap: round; }
.chart .ring { fill: none; stroke: #1c1e21; stroke-width: 1.2; }
.chart .halo { stroke: #ffffff; stroke-width: 4; paint-order: stroke; stroke-linejoin: round; }
@media (prefers-color-scheme: dark) {
  .chart text { fill: #e8eaed; } .chart .soft { fill: #a2a9b3; } .chart .paper { fill: #17191d; }
  .chart .grid { stroke: #3c4149; } .chart .minor { stroke: #2a2e35; } .chart .frame { stroke: #a2a9b3; }
  .chart .front, .chart .ring { stroke: #e8eaed; } .chart .halo { stroke: #17191d; } }
</style>
)";

/// An axis on the paper.
struct Axis {
    LogAxis values;
    double from = 0.0, to = 1.0;  ///< pixels

    double at(double value) const { return from + values.partOf(value) * (to - from); }
};

double clampedEnd(double end, double value) { return std::isfinite(end) && end > 0.0 ? end : value; }

struct Frame {
    Axis time, error;
};

Frame frameOf(const std::vector<ChartCurve>& curves) {
    std::vector<double> times, errors;
    for (const ChartCurve& curve : curves)
        for (const ChartGroup& group : curve.groups) {
            times.push_back(group.deviceSeconds.value);
            errors.insert(errors.end(), {group.error.value, group.error.low, group.error.high});
        }
    return {{logAxisAround(times), kLeft, kLeft + kPlotWidth}, {logAxisAround(errors), kTop + kPlotHeight, kTop}};
}

std::string drawAxes(const Frame& frame, const std::string& errorLabel) {
    std::string svg;
    for (const LogTick& tick : logTicks(frame.time.values)) {
        const double x = frame.time.at(tick.value);
        svg += svgText("<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" class=\"", x, x, kTop, kTop + kPlotHeight) +
               (tick.isLabelled ? "grid\"/>\n" : "minor\"/>\n");
        if (tick.isLabelled)
            svg += svgText("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">", x, kTop + kPlotHeight + 19.0) +
                   secondsText(tick.value) + "</text>\n";
    }
    for (const LogTick& tick : logTicks(frame.error.values)) {
        const double y = frame.error.at(tick.value);
        svg += svgText("<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" class=\"", kLeft, kLeft + kPlotWidth, y, y) +
               (tick.isLabelled ? "grid\"/>\n" : "minor\"/>\n");
        if (tick.isLabelled)
            svg += svgText("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">", kLeft - 8.0, y + 4.5) +
                   shortNumber(tick.value) + "</text>\n";
    }
    svg += svgText("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" class=\"frame\"/>\n", kLeft, kTop,
                kPlotWidth, kPlotHeight);
    svg += svgText("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">time on the device</text>\n",
                kLeft + kPlotWidth / 2, kTop + kPlotHeight + 44.0);
    svg += svgText("<text transform=\"translate(18 %.1f) rotate(-90)\" text-anchor=\"middle\">", kTop + kPlotHeight / 2) +
           xmlEscaped(errorLabel) + "</text>\n";
    return svg;
}

std::string point(const Frame& frame, double seconds, double error) {
    return svgText("%.1f,%.1f ", frame.time.at(seconds), frame.error.at(error));
}

std::string strokeOf(size_t curve) {
    std::string stroke = "stroke=\"" + std::string(curveColor(curve)) + "\"";
    const char* dash = kDashes[curve / kColors.size() % kDashes.size()];
    return *dash != '\0' ? stroke + " stroke-dasharray=\"" + dash + "\"" : stroke;
}

std::string drawBand(const Frame& frame, const ChartCurve& curve, size_t index) {
    std::string up, down;
    for (const ChartGroup& group : curve.groups) {
        const double value = group.error.value;
        up += point(frame, group.deviceSeconds.value, clampedEnd(group.error.high, value));
        down = point(frame, group.deviceSeconds.value, clampedEnd(group.error.low, value)) + down;
    }
    return "<polygon fill=\"" + std::string(curveColor(index)) + "\" fill-opacity=\"0.16\" points=\"" + up + down +
           "\"/>\n";
}

/// Circles, squares, triangles and diamonds in turn.
std::string marker(size_t index, double x, double y) {
    const std::string fill = " fill=\"" + std::string(curveColor(index)) + "\"";
    switch (index % 4) {
        case 0:
            return svgText("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.8\"", x, y) + fill;
        case 1:
            return svgText("<rect x=\"%.1f\" y=\"%.1f\" width=\"7\" height=\"7\"", x - 3.5, y - 3.5) + fill;
        case 2:
            return svgText("<path d=\"M%.1f %.1fl4.4 7.6h-8.8z\"", x, y - 4.8) + fill;
        default:
            return svgText("<path d=\"M%.1f %.1fl4.8 4.8l-4.8 4.8l-4.8 -4.8z\"", x, y - 4.8) + fill;
    }
}

std::string drawCurve(const Frame& frame, const ChartCurve& curve, size_t index) {
    std::string line, markers;
    for (const ChartGroup& group : curve.groups) {
        line += point(frame, group.deviceSeconds.value, group.error.value);
        markers += marker(index, frame.time.at(group.deviceSeconds.value), frame.error.at(group.error.value)) +
                   "><title>" + xmlEscaped(curve.config) + ", " + std::to_string(group.samples) + " samples: error " +
                   shortNumber(group.error.value) + " in " + secondsText(group.deviceSeconds.value) + "</title></" +
                   (index % 4 == 0   ? "circle"
                    : index % 4 == 1 ? "rect"
                                     : "path") +
                   ">\n";
    }
    return "<polyline fill=\"none\" stroke-width=\"1.8\" stroke-linejoin=\"round\" " + strokeOf(index) + " points=\"" +
           line + "\"/>\n" + markers;
}

std::string drawFront(const Frame& frame, const std::vector<ChartCurve>& curves) {
    std::vector<const ChartGroup*> front;
    for (const ChartCurve& curve : curves)
        for (const ChartGroup& group : curve.groups)
            if (group.pareto) front.push_back(&group);
    std::ranges::sort(front, {}, [](const ChartGroup* group) { return group->deviceSeconds.value; });
    std::string line, rings;
    for (const ChartGroup* group : front) {
        line += point(frame, group->deviceSeconds.value, group->error.value);
        rings += svgText("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"7\" class=\"ring\"/>\n",
                      frame.time.at(group->deviceSeconds.value), frame.error.at(group->error.value));
    }
    return "<polyline class=\"front\" points=\"" + line + "\"/>\n" + rings;
}

std::string drawPlateaus(const Frame& frame, const std::vector<ChartCurve>& curves) {
    std::string svg;
    double free = -std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < curves.size(); ++i) {
        if (curves[i].plateau != Plateau::bias || curves[i].groups.empty()) continue;
        const ChartGroup& last = curves[i].groups.back();
        const double x = std::min(frame.time.at(last.deviceSeconds.value), kLeft + kPlotWidth - 4.0);
        double y = frame.error.at(last.error.value) - 11.0;
        if (std::abs(y - free) < 13.0) y = free - 13.0;
        free = y;
        svg += svgText("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\" class=\"small halo\">", x, y) + "bias " +
               shortNumber(curves[i].bias.value) + "</text>\n";
    }
    return svg;
}

std::string slopeText(const ChartCurve& curve) {
    if (!curve.fit) return curve.groups.empty() ? "no points" : "one point";
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "slope %.2f", curve.fit->slope);
    std::string result = buffer.data();
    if (curve.fit->degrees > 0) {
        std::snprintf(buffer.data(), buffer.size(), " \u00b1 %.2f", curve.fit->slopeError);
        result += buffer.data();
    }
    if (curve.plateau == Plateau::bias) result += ", bias " + shortNumber(curve.bias.value);
    if (curve.plateau == Plateau::referenceNoise) result += ", flat: the reference's noise";
    if (curve.plateau == Plateau::unexplained) result += ", flat: unexplained";
    return result;
}

std::string drawLegend(const std::vector<ChartCurve>& curves) {
    std::string svg;
    double y = kTop + 10.0;
    for (size_t i = 0; i < curves.size(); ++i, y += kLegendLine) {
        svg += svgText("<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke-width=\"1.8\" ", kLegendX,
                    kLegendX + 26.0, y, y) +
               strokeOf(i) + "/>\n" + marker(i, kLegendX + 13.0, y) + "/>\n";
        svg +=
            svgText("<text x=\"%.1f\" y=\"%.1f\">", kLegendX + 34.0, y + 4.0) + xmlEscaped(curves[i].config) + "</text>\n";
        svg += svgText("<text x=\"%.1f\" y=\"%.1f\" class=\"soft small\">", kLegendX + 34.0, y + 18.0) +
               xmlEscaped(slopeText(curves[i])) + "</text>\n";
    }
    svg += svgText("<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" class=\"front\"/>", kLegendX, kLegendX + 26.0, y,
                y) +
           svgText("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"7\" class=\"ring\"/>\n", kLegendX + 13.0, y) +
           svgText("<text x=\"%.1f\" y=\"%.1f\">Pareto front</text>\n", kLegendX + 34.0, y + 4.0);
    return svg;
}

}  // namespace

std::string_view curveColor(size_t curve) { return kColors[curve % kColors.size()]; }

std::string xmlEscaped(const std::string& raw) {
    std::string escaped;
    for (const char c : raw) switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    return escaped;
}

std::vector<double> axisNumbers(double low, double high) {
    std::vector<double> numbers;
    for (const LogTick& tick : logTicks({std::log10(low), std::log10(high)}))
        if (tick.isLabelled) numbers.push_back(tick.value);
    return numbers;
}

std::string chartSvg(const std::vector<ChartCurve>& curves, const ChartLabels& labels) {
    const Frame frame = frameOf(curves);
    const double legendBottom = kTop + kLegendLine * (static_cast<double>(curves.size()) + 1.0);
    const double height = std::max(kTop + kPlotHeight + kBottom, legendBottom + 10.0);
    std::string svg = svgText(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"chart\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" "
        "height=\"%.0f\" role=\"img\">\n",
        kWidth, height, kWidth, height);
    svg += kStyle;
    svg += "<title>" + xmlEscaped(labels.title) + "</title>\n";
    svg += svgText("<rect width=\"%.0f\" height=\"%.0f\" class=\"paper\"/>\n", kWidth, height);
    svg += svgText("<text x=\"%.1f\" y=\"26\" class=\"title\">", kLeft) + xmlEscaped(labels.title) + "</text>\n";
    svg += svgText("<text x=\"%.1f\" y=\"46\" class=\"soft\">", kLeft) + xmlEscaped(labels.subtitle) + "</text>\n";
    svg += drawAxes(frame, labels.errorAxis);
    for (size_t i = 0; i < curves.size(); ++i)
        if (!curves[i].groups.empty()) svg += drawBand(frame, curves[i], i);
    for (size_t i = 0; i < curves.size(); ++i)
        if (!curves[i].groups.empty()) svg += drawCurve(frame, curves[i], i);
    return svg + drawFront(frame, curves) + drawPlateaus(frame, curves) + drawLegend(curves) + "</svg>\n";
}

}  // namespace raylab
