#include "ui/report/plot_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "engine/measure/log_axis.h"
#include "ui/report/chart_output.h"
#include "ui/report/chart_svg.h"
#include "ui/report/svg_text.h"

namespace raylab {
namespace {

using stability::Plot;
using stability::PlotSeries;

constexpr double kPaperWidth = 340.0, kPaperHeight = 250.0;
constexpr double kPaperLeft = 54.0, kPaperRight = 330.0, kPaperTop = 10.0, kPaperBottom = 208.0;
constexpr double kNameHeight = 14.0;
/// Of a linear axis: so many numbers at most, and room beyond the values as a part of it.
constexpr double kMostNumbers = 6.0, kRoom = 0.05;

/// An axis on the paper, linear or logarithmic.
struct PlotAxis {
    bool isLog = true;
    double low = 0.0, high = 1.0;   ///< values, or their decimal logarithms
    double from = 0.0, to = 1.0;    ///< pixels
    std::vector<double> numbers{};  ///< that are written beside it

    double at(double value) const {
        const double part = ((isLog ? std::log10(value) : value) - low) / (high - low);
        return from + std::clamp(part, 0.0, 1.0) * (to - from);
    }
};

/// 1, 2 or 5 times a power of ten: so that at most kMostNumbers fit between the ends.
double linearStep(double low, double high) {
    const double power = std::pow(10.0, std::floor(std::log10((high - low) / kMostNumbers)));
    for (const double factor : {1.0, 2.0, 5.0})
        if ((high - low) / (factor * power) <= kMostNumbers) return factor * power;
    return 10.0 * power;
}

PlotAxis linearAxis(const std::vector<double>& values, double from, double to) {
    const auto [least, most] = std::ranges::minmax_element(values);
    const double room = std::max(kRoom * (*most - *least), 1e-6 * std::max(std::abs(*most), 1.0));
    PlotAxis axis{false, *least - room, *most + room, from, to};
    const double step = linearStep(axis.low, axis.high);
    for (double number = std::ceil(axis.low / step) * step; number <= axis.high; number += step)
        axis.numbers.push_back(std::abs(number) < 1e-9 * step ? 0.0 : number);
    return axis;
}

PlotAxis logarithmicAxis(const std::vector<double>& values, double from, double to) {
    const LogAxis around = logAxisAround(values);
    return {true, around.low, around.high,
            from, to,         axisNumbers(std::pow(10.0, around.low), std::pow(10.0, around.high))};
}

PlotAxis axisOf(const Plot& plot, int component, bool isLog, double from, double to) {
    std::vector<double> values;
    for (const PlotSeries& series : plot.series)
        for (const glm::dvec2& point : series.points)
            if (std::isfinite(point[component])) values.push_back(point[component]);
    if (values.empty()) values.push_back(1.0);
    return isLog ? logarithmicAxis(values, from, to) : linearAxis(values, from, to);
}

std::string drawAxes(const Plot& plot, const PlotAxis& x, const PlotAxis& y) {
    std::string svg;
    for (const double number : x.numbers)
        svg += svgText("<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>", x.at(number),
                    x.at(number), kPaperTop, kPaperBottom) +
               svgText("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">", x.at(number), kPaperBottom + 14.0) +
               shortNumber(number) + "</text>\n";
    for (const double number : y.numbers)
        svg += svgText("<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>", kPaperLeft, kPaperRight,
                    y.at(number), y.at(number)) +
               svgText("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">", kPaperLeft - 4.0, y.at(number) + 3.5) +
               shortNumber(number) + "</text>\n";
    svg += svgText("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#666\"/>\n", kPaperLeft,
                kPaperTop, kPaperRight - kPaperLeft, kPaperBottom - kPaperTop);
    svg += svgText("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">", 0.5 * (kPaperLeft + kPaperRight), kPaperBottom + 32.0) +
           xmlEscaped(plot.xLabel) + "</text>\n";
    return svg +
           svgText("<text transform=\"translate(11 %.1f) rotate(-90)\" text-anchor=\"middle\">", 0.5 * (kPaperTop + kPaperBottom)) +
           xmlEscaped(plot.yLabel) + "</text>\n";
}

std::string drawSeries(const PlotSeries& series, size_t index, const PlotAxis& x, const PlotAxis& y) {
    const std::string color(curveColor(index));
    std::string line, marks;
    for (const glm::dvec2& point : series.points) {
        if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
        line += svgText("%.1f,%.1f ", x.at(point.x), y.at(point.y));
        marks +=
            svgText("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.5\" fill=\"", x.at(point.x), y.at(point.y)) + color + "\"/>";
    }
    if (!series.isLine) return marks + "\n";
    return "<polyline fill=\"none\" stroke=\"" + color + "\" stroke-width=\"1.4\" points=\"" + line + "\"/>" + marks +
           "\n";
}

}  // namespace

std::string plotSvg(const Plot& plot) {
    const PlotAxis x = axisOf(plot, 0, plot.logX, kPaperLeft, kPaperRight), y = axisOf(plot, 1, plot.logY, kPaperBottom, kPaperTop);
    std::string svg =
        svgText("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" ", kPaperWidth, kPaperHeight) +
        "style=\"font:11px system-ui,sans-serif;background:#fff\">\n" + drawAxes(plot, x, y);
    for (size_t i = 0; i < plot.series.size(); ++i) {
        svg += drawSeries(plot.series[i], i, x, y);
        if (plot.series.size() < 2) continue;
        svg += svgText("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\" fill=\"", kPaperRight - 6.0,
                    kPaperTop + kNameHeight * static_cast<double>(i + 1)) +
               std::string(curveColor(i)) + "\">" + xmlEscaped(plot.series[i].name) + "</text>\n";
    }
    return svg + "</svg>";
}

}  // namespace raylab
