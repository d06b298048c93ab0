#pragma once

#include <string>

#include "ui/report/chart_output.h"

namespace raylab {

/// The report of a chart as one HTML page without anything from outside: the answer, the chart, pictures at equal time
/// with their errors, tables of equal error and equal time, slopes and biases, and the command of each configuration.
std::string chartReport(const Chart& chart, const ChartTables& tables);

/// What the chart is headed with, there and in its files.
std::string chartTitle(const Chart& chart);
std::string chartSubtitle(const Chart& chart);
std::string errorAxisLabel(const Chart& chart);

/// A script that draws the same chart as chart.png; its points stand in it.
std::string chartGnuplot(const Chart& chart);

}  // namespace raylab
