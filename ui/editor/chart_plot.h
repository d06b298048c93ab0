#pragma once

#include <optional>
#include <string>

#include "engine/measure/target_cost.h"
#include "ui/editor/plot.h"
#include "ui/report/chart_files.h"

namespace raylab {

/// ImGui's colour of a curve: that of the chart's files, lightened for a dark ground.
uint32_t plotColor(size_t curve);

/// A chart's curves with their bands, its Pareto front, and the target as a line; 0: none. `lit`: the one curve that is
/// not dimmed. Series are numbered as the curves are, points as their groups.
PlotSpec plotOf(const Chart& chart, double targetError, std::optional<size_t> lit);

/// The number of samples and the time that a film which grows will take for an error, in words; by `curve`'s slope
/// where there is one. Says so where bias will not let it come there.
std::string costText(const NoiseState& now, double targetError, const ChartCurve* curve);

/// Which curve is the first to come to an error, in words.
std::string cheapestText(const Chart& chart, double targetError);

}  // namespace raylab
