#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/measure/chart_analysis.h"

namespace raylab {

/// A curve's colour, told apart also by the colour-blind: Okabe and Ito, "Color Universal Design", 2008, without
/// yellow, which white swallows. "#rrggbb"
std::string_view curveColor(size_t curve);

/// Text that means the same in XML and HTML.
std::string xmlEscaped(const std::string& text);

/// Where a logarithmic axis has a number: powers of ten, and 2 and 5 times these, or all, where powers are few.
std::vector<double> axisNumbers(double low, double high);

/// What an SVG of a chart is headed and labelled with.
struct ChartLabels {
    std::string title;
    std::string subtitle;
    std::string errorAxis;
};

/// Error over device time, both logarithmic: a band for each curve's intervals, its points, the Pareto front as a line
/// with ringed points, and plateaus named. An <svg> element of its own, without anything from outside, for light and
/// dark. Curves without points are in the legend only.
std::string chartSvg(const std::vector<ChartCurve>& curves, const ChartLabels& labels);

}  // namespace raylab
