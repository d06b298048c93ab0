#pragma once

#include <string>
#include <vector>

#include "ui/report/chart_files.h"

namespace raylab {

/// Figures of all curves for one value of a table: times for an error, or errors for a time.
struct ChartTableRow {
    double at = 0.0;
    std::vector<std::optional<Interval>> figures;  ///< of each curve
    std::optional<ChartBest> best;
};

struct ChartTables {
    std::vector<ChartTableRow> equalError;  ///< times, by rising error
    std::vector<ChartTableRow> equalTime;   ///< errors, by rising time
};

ChartTables makeTables(const Chart& chart);

/// "For an error of E the cheapest is X ...; for T milliseconds the most accurate is Y ..."; with what it is not sure
/// of.
std::string chartAnswer(const Chart& chart, const ChartTables& tables);

/// What a curve's plateau is, in words; empty for none.
std::string plateauText(const ChartCurve& curve);

/// "12.3 ms", "4.56 s".
std::string secondsText(double seconds);
/// Three significant digits.
std::string shortNumber(double value);

void writeChartJson(const Chart& chart);

/// chart.json, chart.svg, chart.gnuplot, report.html, and chart.png where gnuplot is installed.
void writeChartOutput(const Chart& chart);

/// All files of a chart that has ended but its pictures.
void writeChart(const Chart& chart);

/// The curves and the answer, to standard output.
void printChart(const Chart& chart);

}  // namespace raylab
