#include "ui/report/plot_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "engine/measure/log_axis.h"
#include "ui/report/chart_output.h"
#include "ui/report/chart_svg.h"

namespace raylab {
namespace {

using stability::Plot;
using stability::PlotSeries;

constexpr double kWidth = 340.0, kHeight = 250.0;
constexpr double kLeft = 54.0, kRight = 330.0, kTop = 10.0, kBottom = 208.0;
constexpr double kNameHeight = 14.0;
/// Of a linear axis: so many numbers at most, and room beyond the values as a part of it.
constexpr double kMostNumbers = 6.0, kRoom = 0.05;

std::string text(const char* format, double a, double b = 0.0, double c = 0.0, double d = 0.0) {
    std::array<char, 192> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, a, b, c, d);
    return buffer.data();
}

/// An axis on the paper, linear or logarithmic.
struct Axis {
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

Axis linearAxis(const std::vector<double>& values, double from, double to) {
    const auto [least, most] = std::ranges::minmax_element(values);
    const double room = std::max(kRoom * (*most - *least), 1e-6 * std::max(std::abs(*most), 1.0));
    Axis axis{false, *least - room, *most + room, from, to};
    const double step = linearStep(axis.low, axis.high);
    for (double number = std::ceil(axis.low / step) * step; number <= axis.high; number += step)
        axis.numbers.push_back(std::abs(number) < 1e-9 * step ? 0.0 : number);
    return axis;
}

Axis logarithmicAxis(const std::vector<double>& values, double from, double to) {
    const LogAxis around = logAxisAround(values);
    return {true, around.low, around.high,
            from, to,         axisNumbers(std::pow(10.0, around.low), std::pow(10.0, around.high))};
}

Axis axisOf(const Plot& plot, int component, bool isLog, double from, double to) {
    std::vector<double> values;
    for (const PlotSeries& series : plot.series)
        for (const glm::dvec2& point : series.points)
            if (std::isfinite(point[component])) values.push_back(point[component]);
    if (values.empty()) values.push_back(1.0);
    return isLog ? logarithmicAxis(values, from, to) : linearAxis(values, from, to);
}

std::string drawAxes(const Plot& plot, const Axis& x, const Axis& y) {
    std::string svg;
    for (const double number : x.numbers)
        svg += text("<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>", x.at(number),
                    x.at(number), kTop, kBottom) +
               text("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">", x.at(number), kBottom + 14.0) +
               shortNumber(number) + "</text>\n";
    for (const double number : y.numbers)
        svg += text("<line x1=\"%.1f\" x2=\"%.1f\" y1=\"%.1f\" y2=\"%.1f\" stroke=\"#ddd\"/>", kLeft, kRight,
                    y.at(number), y.at(number)) +
               text("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">", kLeft - 4.0, y.at(number) + 3.5) +
               shortNumber(number) + "</text>\n";
    svg += text("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#666\"/>\n", kLeft,
                kTop, kRight - kLeft, kBottom - kTop);
    svg += text("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">", 0.5 * (kLeft + kRight), kBottom + 32.0) +
           xmlEscaped(plot.xLabel) + "</text>\n";
    return svg +
           text("<text transform=\"translate(11 %.1f) rotate(-90)\" text-anchor=\"middle\">", 0.5 * (kTop + kBottom)) +
           xmlEscaped(plot.yLabel) + "</text>\n";
}

std::string drawSeries(const PlotSeries& series, size_t index, const Axis& x, const Axis& y) {
    const std::string color(curveColor(index));
    std::string line, marks;
    for (const glm::dvec2& point : series.points) {
        if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
        line += text("%.1f,%.1f ", x.at(point.x), y.at(point.y));
        marks +=
            text("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"2.5\" fill=\"", x.at(point.x), y.at(point.y)) + color + "\"/>";
    }
    if (!series.isLine) return marks + "\n";
    return "<polyline fill=\"none\" stroke=\"" + color + "\" stroke-width=\"1.4\" points=\"" + line + "\"/>" + marks +
           "\n";
}

}  // namespace

std::string plotSvg(const Plot& plot) {
    const Axis x = axisOf(plot, 0, plot.logX, kLeft, kRight), y = axisOf(plot, 1, plot.logY, kBottom, kTop);
    std::string svg =
        text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" ", kWidth, kHeight) +
        "style=\"font:11px system-ui,sans-serif;background:#fff\">\n" + drawAxes(plot, x, y);
    for (size_t i = 0; i < plot.series.size(); ++i) {
        svg += drawSeries(plot.series[i], i, x, y);
        if (plot.series.size() < 2) continue;
        svg += text("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\" fill=\"", kRight - 6.0,
                    kTop + kNameHeight * static_cast<double>(i + 1)) +
               std::string(curveColor(i)) + "\">" + xmlEscaped(plot.series[i].name) + "</text>\n";
    }
    return svg + "</svg>";
}

}  // namespace raylab
