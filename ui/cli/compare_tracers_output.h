#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/measure/compare_tracers.h"
#include "engine/measure/image_error.h"
#include "engine/measure/ray_bench.h"
#include "ui/cli/options.h"

namespace raylab {

/// One of the two configurations.
struct CompareSide {
    std::string text;         ///< as the user wrote it
    RenderSettings settings;  ///< resolved
    bool isDefault = false;   ///< traces by the default software configuration
    std::string peer;  ///< "embree", "embree-robust": it traces by none of the settings; empty: one of raylab's tracers
};

struct ImageComparison {
    std::array<uint32_t, 2> samples{};  ///< of A and B
    ImageError error;                   ///< of B against A
    std::optional<ZTest> zTest;         ///< nothing where the samples are not as many, or only one
    bool passed = true;
};

/// A kind of ray, A's row and B's.
struct KindTimes {
    BenchRow a;
    BenchRow b;

    double ratio() const { return b.mraysPerSecond / a.mraysPerSecond; }
    /// Of B's rate to A's by the ends of both intervals: at least 86 % likely to hold the ratio of the medians.
    double lowRatio() const { return b.low / a.high; }
    double highRatio() const { return b.high / a.low; }
};

/// What `raylab compare-tracers` found; a step that was not asked for is absent.
struct CompareTracersRun {
    Device& device;
    std::string scene;
    RenderSettings common;
    std::array<CompareSide, 2> sides;
    std::optional<RayComparison> hits;
    std::optional<ImageComparison> images;
    std::optional<std::vector<KindTimes>> times;
    std::vector<std::string> leftOut;   ///< a sentence for each thing that the time limit cut short
    std::vector<std::string> failures;  ///< a sentence for each reason of exit code 1
};

void printCompareTracers(const CompareTracersRun& run);
/// What the colours of the heat map mean.
void printHeatLegend();
/// schema raylab.compare-tracers/1.
nlohmann::ordered_json compareTracersJson(const CompareTracersRun& run);

}  // namespace raylab
