#pragma once

#include <functional>

#include "ui/report/chart_files.h"

namespace raylab {

/// What a chart is asked for.
struct ChartOrder {
    std::string scene;                 ///< as the user names it
    std::filesystem::path folder;      ///< of its files, which follow each point; empty: there are none
    std::vector<ChartConfig> configs;  ///< as chartConfigs() makes them
    int seeds = 4;                     ///< as in ChartPlan, down to the time limit
    int levels = 8;
    uint32_t firstSeed = 0;
    double timeLimit = 0.0;
    double targetError = 0.0;  ///< that the answer is for; 0: it chooses one
    ErrorMeasure measure = ErrorMeasure::relative;
    std::string reference = "path";  ///< path, own, or a file: docs/charts.md
    double referenceError = 0.01;    ///< relative error that references are rendered to
};

/// Who looks on while a chart is measured. All are called from the thread that measures.
struct ChartWatch {
    std::function<bool()> stop;                    ///< asked between dispatches
    std::function<void(double done)> onReference;  ///< the part of a reference that is rendered
    /// A point was measured: `done` of all, and its image, which nobody keeps.
    std::function<void(const Chart& chart, const ChartShot& shot, double done)> onPoint;
};

/// Measures what `order` asks for, and goes on from what its folder holds. Where the watch says stop, the chart is what
/// was measured until then, and isInterrupted; so it is where the device is lost, as deviceLoss says. The scene's
/// environment must not be settled. Throws Error, also where it is stopped before there is a reference, and DeviceLost
/// where the device is lost before.
Chart runChart(Device& device, const Scene& scene, const ChartOrder& order, const ChartWatch& watch);

}  // namespace raylab
