#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ui/editor/chart_feed.h"
#include "ui/editor/context.h"

namespace raylab {

/// What the Chart panel will measure.
struct ChartQueue {
    std::vector<ChartConfig> configs;
    int width = 320;  ///< of the pictures; their height by the aspect of the settings
    int seeds = 3;
    int levels = 6;
    double seconds = 60.0;  ///< of rendering, shared by all
    ErrorMeasure measure = ErrorMeasure::relative;
    std::string reference = "path";
    double referenceError = 0.02;
};

/// "depth=4 sampler=independent": what settings a configuration changes from the defaults; those that a chart chooses,
/// or that only say how a picture is shown, are left out. "default" where there is none.
std::string configName(const RenderSettings& settings);

/// Whether both render alike but for what a chart chooses.
bool isSameMethod(const RenderSettings& a, const RenderSettings& b);

/// Adds what is not in the queue yet; a name that is there already, of other settings, gets a number.
void addToQueue(ChartQueue& queue, const std::vector<ChartConfig>& configs);

/// The settings of a configuration over those of the document, which keeps its size, view, seed and goals.
RenderSettings adoptedSettings(const RenderSettings& document, const RenderSettings& config, uint32_t samples);

/// Measures the queue on the scene as it is seen, on a device of its own. The viewport waits meanwhile.
void startChart(EditorContext& context, const ChartQueue& queue, double targetError,
                const std::shared_ptr<ChartFeed>& feed);

/// Writes what `raylab chart -o FOLDER` would have, in the background.
void exportChart(EditorContext& context, const std::shared_ptr<ChartFeed>& feed, const std::string& folder);

}  // namespace raylab
