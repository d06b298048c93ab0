#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/measure/chart_points.h"
#include "engine/measure/statistics.h"

namespace raylab {

/// A configuration with so many samples: what its seeds say together.
struct ChartGroup {
    uint32_t samples = 0;
    size_t seeds = 0;
    Interval error;  ///< charted; geometric mean and its interval
    double medianError = 0.0;
    Interval deviceSeconds;  ///< of one rendering; median, and the interval of the geometric mean
    Interval wallSeconds;
    std::optional<BiasEstimate> bias;
    bool pareto = false;          ///< no other group is faster and no less accurate (to .001 of it)
    bool paretoPossible = false;  ///< none is so beyond the intervals of both
};

/// Why a curve becomes flat.
enum class Plateau {
    none,
    bias,            ///< the images of all seeds together are off the reference by more than chance explains
    referenceNoise,  ///< what is left is mostly the reference's own noise
    unexplained,     ///< flat, and neither: more samples, or more seeds, would tell
};
std::string_view nameOf(Plateau plateau);

/// One line of the chart.
struct ChartCurve {
    std::string config;
    std::vector<ChartGroup> groups;  ///< by rising samples
    std::optional<LineFit> fit;      ///< of log error over log samples, all points
    std::optional<LineFit> tail;     ///< of the last half of the groups, three at least
    Plateau plateau = Plateau::none;
    /// Square root of the latest group's unbiased estimate, and of the ends of its interval; those below 0 are 0.
    Interval bias;
};

/// A slope of error over samples that is above this with confidence is a plateau; noise alone has -1/2.
constexpr double kPlateauSlope = -0.25;
/// One-sided: a bias is called one where chance has less than this probability. Many groups are judged.
constexpr double kBiasSignificance = 1e-3;
/// Standard errors of that significance, of a normal estimate.
constexpr double kBiasStandardErrors = 3.0902;

/// One curve for each of `configs`, in that order. `referenceNoise`: mean square that the reference adds to each
/// config's squared error (0 for ErrorMeasure::flip, which has no such sum).
std::vector<ChartCurve> analyseChart(const ChartTable& table, const std::vector<std::string>& configs,
                                     ErrorMeasure measure, const std::vector<double>& referenceNoise);

/// For each point of the table what the curves say of its group.
std::vector<ChartMark> marksOf(const ChartTable& table, const std::vector<ChartCurve>& curves);

/// Sets pareto and paretoPossible of all groups: by device time and error.
void markPareto(std::vector<ChartCurve>& curves);

/// The error at a time, interpolated between the groups on either side in logarithms; nothing outside of what was
/// measured. `seconds`: of the device.
std::optional<Interval> errorAtTime(const ChartCurve& curve, double seconds);

/// The time at which the curve first falls to an error, interpolated likewise; its ends are where the ends of the
/// error's interval do so, the upper one infinite where it does not. Nothing where the curve never does, or begins
/// below.
std::optional<Interval> timeToError(const ChartCurve& curve, double error);

/// Round values (1, 2, 5 times a power of ten) for a table, rising: errors that a curve reaches, times that one has.
std::vector<double> tableErrors(const std::vector<ChartCurve>& curves);
std::vector<double> tableTimes(const std::vector<ChartCurve>& curves);

/// The best of the configurations by some figure, the less the better.
struct ChartBest {
    size_t curve = 0;
    Interval value;
    std::vector<size_t> ties;  ///< others whose intervals reach below the upper end of the best one's
};

/// Over figures of all curves, nothing for those that have none. Nothing where none has.
std::optional<ChartBest> bestOf(const std::vector<std::optional<Interval>>& figures);

}  // namespace raylab
