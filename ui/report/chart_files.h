#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/image/image8.h"
#include "engine/measure/chart_analysis.h"
#include "engine/measure/chart_run.h"

namespace raylab {

/// A chart as it stands: what its files are written from.
struct Chart {
    std::filesystem::path folder;
    std::string scene;      ///< as the user named it
    std::string sceneHash;  ///< of its contents
    std::string device;
    std::string referenceChoice;  ///< path, own, or the hash of the file's bytes
    double referenceError = 0.0;  ///< that was asked for
    double targetError = 0.0;     ///< that the report answers for besides its own choice; 0: none
    ChartPlan plan;
    std::vector<std::shared_ptr<const Reference>> references;  ///< of each configuration
    ChartTable table;
    std::vector<PartialSeeds> partials;  ///< once the run has ended: for one that resumes it
    std::vector<ChartCurve> curves;
    std::vector<int> levelLimits;  ///< below plan.levels: the time limit ended it
    std::vector<std::optional<RenderTimes>> setupTimes;
    bool isInterrupted = false;
    std::string deviceLoss;  ///< what the driver said when it ended the run; empty: it did not

    std::filesystem::path csvFile() const { return folder / "chart.csv"; }
    std::filesystem::path jsonFile() const { return folder / "chart.json"; }
    /// A small picture of a configuration with so many samples, and of its error.
    std::filesystem::path pictureFile(size_t config, uint32_t samples) const;
    std::filesystem::path heatFile(size_t config, uint32_t samples) const;
    /// "raylab render ..." for a configuration, without seed, samples and output.
    std::string renderCommand(size_t config) const;
};

/// Computes the curves from the table.
void analyse(Chart& chart);

void writeChartCsv(const Chart& chart);

/// What makes points comparable: of the scene, the device, the reference and each configuration.
nlohmann::ordered_json chartIdentity(const Chart& chart);

/// What an earlier run left in the folder, nothing for an empty one.
struct EarlierChart {
    ChartTable table;
    std::vector<PartialSeeds> partials;
};

/// Throws Error, saying what differs, where the folder holds points of another scene, device, reference or settings, or
/// a table of unknown origin.
std::optional<EarlierChart> loadEarlier(const Chart& chart);

/// The chart's seeds without their last ones, for the run that resumes; what was there before goes.
void writePartials(const Chart& chart);

/// A point as it is looked at: the picture as a display shows it, and its error map.
struct ChartPictures {
    Image8 image;
    Image8 heat;
};

/// Of at most 320 pixels a row.
ChartPictures makePictures(const Chart& chart, const ChartShot& shot);

/// As PNG files.
void writePictures(const Chart& chart, size_t config, uint32_t samples, const ChartPictures& pictures);

}  // namespace raylab
