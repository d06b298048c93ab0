#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "ui/report/chart_report.h"
#include "ui/report/chart_svg.h"
#include "ui/report/gnuplot.h"

namespace raylab {
namespace {

/// Of the axes around what they show, a factor.
constexpr double kRoom = 1.25;

/// Ends that are not known are the value itself.
double endOr(double end, double value) { return std::isfinite(end) && end > 0.0 ? end : value; }

void writeBlocks(std::ostringstream& text, const Chart& chart) {
    for (size_t i = 0; i < chart.curves.size(); ++i) {
        text << "# samples seconds error low high\n$curve" << i << " << EOD\n";
        for (const ChartGroup& g : chart.curves[i].groups)
            text << g.samples << " " << g.deviceSeconds.value << " " << g.error.value << " "
                 << endOr(g.error.low, g.error.value) << " " << endOr(g.error.high, g.error.value) << "\n";
        text << "EOD\n";
    }
    text << "$front << EOD\n";
    for (const ChartCurve& curve : chart.curves)
        for (const ChartGroup& g : curve.groups)
            if (g.pareto) text << g.deviceSeconds.value << " " << g.error.value << "\n";
    text << "EOD\n";
}

void writeLabels(std::ostringstream& text, const Chart& chart) {
    for (const ChartCurve& curve : chart.curves) {
        if (curve.plateau != Plateau::bias || curve.groups.empty()) continue;
        const ChartGroup& last = curve.groups.back();
        text << "set label " << gnuplotQuoted("bias " + shortNumber(curve.bias.value)) << " noenhanced at "
             << last.deviceSeconds.value << "," << last.error.value << " right offset 0,0.8\n";
    }
}

/// Range and numbers of an axis, for the values of all groups.
void writeAxis(std::ostringstream& text, const Chart& chart, const char* axis, std::string (*show)(double),
               Interval ChartGroup::*value) {
    double low = std::numeric_limits<double>::infinity(), high = 0.0;
    for (const ChartCurve& curve : chart.curves)
        for (const ChartGroup& g : curve.groups) {
            low = std::min(low, endOr((g.*value).low, (g.*value).value));
            high = std::max(high, endOr((g.*value).high, (g.*value).value));
        }
    if (!(low > 0.0 && low < high)) return;
    text << "set " << axis << "range [" << low / kRoom << ":" << high * kRoom << "]\nset " << axis << "tics (";
    const char* separator = "";
    for (const double number : axisNumbers(low / kRoom, high * kRoom)) {
        text << separator << gnuplotQuoted(show(number)) << " " << number;
        separator = ", ";
    }
    text << ")\n";
}

}  // namespace

std::string chartGnuplot(const Chart& chart) {
    std::ostringstream text;
    text
        << "# chart.png; for another format change the next two lines\n"
        << "set terminal pngcairo size 1500,820 font 'sans,17' linewidth 1.4\nset output 'chart.png'\n"
        << "set encoding utf8\nset logscale xy\nset grid xtics ytics linetype 1 linewidth 0.5 linecolor rgb '#d0d5db'\n"
        << "set key outside right top Left reverse noenhanced\nset xlabel 'time on the device'\nset ylabel "
        << gnuplotQuoted(errorAxisLabel(chart)) << " noenhanced\nset title " << gnuplotQuoted(chartTitle(chart))
        << ".\"\\n\"." << gnuplotQuoted(chartSubtitle(chart)) << " noenhanced\n";
    writeAxis(text, chart, "x", secondsText, &ChartGroup::deviceSeconds);
    writeAxis(text, chart, "y", shortNumber, &ChartGroup::error);
    writeBlocks(text, chart);
    writeLabels(text, chart);
    const char* separator = "plot ";
    for (size_t i = 0; i < chart.curves.size(); ++i) {
        if (chart.curves[i].groups.empty()) continue;
        const std::string color = "'" + std::string(curveColor(i)) + "'";
        text << separator << "$curve" << i
             << " using 2:4:5 with filledcurves fillstyle transparent solid 0.16 linecolor rgb " << color
             << " notitle, $curve" << i << " using 2:3 with linespoints pointtype " << 4 + 2 * (i % 5) + 1
             << " linecolor rgb " << color << " title " << gnuplotQuoted(chart.curves[i].config);
        separator = ", \\\n  ";
    }
    text << separator
         << "$front using 1:2 smooth unique with linespoints dashtype 3 linecolor rgb '#1c1e21' pointtype 6 "
         << "pointsize 2.2 title 'Pareto front'\n";
    return text.str();
}

}  // namespace raylab
