#pragma once

#include <string>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/measure/chart_run.h"

namespace raylab {

/// Names of the sets of configurations that come with raylab.
std::vector<std::string> chartSetNames();

/// Why there is nothing to compare in a set, which waits for a method that raylab has not got; empty where there is.
std::string missingForChartSet(const std::string& name);

/// What the user asked a chart to compare.
struct ChartRequest {
    std::vector<std::string> sets;  ///< names; those of several sets stand side by side
    std::vector<std::string> vary;  ///< NAME=A,B,C: every combination, of each configuration
    std::string file;               ///< JSON: see docs/charts.md; empty: none
};

/// Named configurations over the base, resolved for device and scene, none twice; the base alone where nothing is asked for.
/// What a device cannot run is left out of a set, with a notice. Throws Error for what is no set, no setting or no
/// value of one, and for a tracer that was asked for and is missing.
std::vector<ChartConfig> chartConfigs(const RenderSettings& base, const ChartRequest& request,
                                      const DeviceDescription& device, const Scene& scene);

}  // namespace raylab
