#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "engine/measure/seed_images.h"

namespace raylab {

/// What a chart has on its vertical axis.
enum class ErrorMeasure {
    relative,  ///< sqrt(relMse)
    rmse,
    flip,  ///< mean LDR-FLIP of the tone mapped images
};

/// "relative", "rmse" or "flip"; the text of anything else throws Error.
ErrorMeasure parseErrorMeasure(const std::string& text);
std::string_view nameOf(ErrorMeasure measure);
std::vector<std::string> errorMeasureNames();

/// One rendering, measured. Nothing else of its chart has the same seed and samples but other configurations.
struct ChartPoint {
    std::string config;
    uint32_t seed = 0;
    uint32_t samples = 0;        ///< a pixel
    double deviceSeconds = 0.0;  ///< of the device's own clock, for its dispatches
    double wallSeconds = 0.0;    ///< of rendering; without build, upload and compile
    double rmse = 0.0;
    double relMse = 0.0;
    double flip = 0.0;

    double error(ErrorMeasure measure) const;
    bool operator==(const ChartPoint&) const = default;
};

/// What the images of one configuration with so many samples said together.
struct ChartBias {
    std::string config;
    uint32_t samples = 0;
    BiasEstimate estimate;
};

/// What a table has of a point besides itself: of its configuration with so many samples.
struct ChartMark {
    double low = 0.0;  ///< ends of the interval of the charted error
    double high = 0.0;
    bool pareto = false;          ///< nothing measured is both faster and more accurate
    bool paretoPossible = false;  ///< nothing measured is so with confidence
};

/// The points of a chart as they are kept on disk.
struct ChartTable {
    std::vector<ChartPoint> points;
    std::vector<ChartBias> biases;
};

/// One row a point, with a header, by numbers that are read back to the bit:
/// config,seed,samples,deviceSeconds,wallSeconds,rmse,relMse,flip,error,low,high,pareto,paretoPossible,biasSquared,
/// biasSquaredError,variance. `marks` is as long as the points; where nothing is known of a bias its fields are empty,
/// as are ends that are NaN.
std::string chartCsv(const ChartTable& table, const std::vector<ChartMark>& marks, ErrorMeasure measure);

/// Reads what chartCsv wrote; the columns are found by name. Throws Error, naming the file and the line, for what is no
/// such table.
ChartTable readChartCsv(const std::filesystem::path& path);

}  // namespace raylab
