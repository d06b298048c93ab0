#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/chart_points.h"
#include "engine/measure/reference.h"
#include "engine/render/renderer.h"

namespace raylab {

struct ChartConfig {
    std::string name;
    RenderSettings settings;  ///< resolved for the device; its seed and samples are the chart's business
};

/// What a chart measures.
struct ChartPlan {
    std::vector<ChartConfig> configs;
    int seeds = 4;   ///< of each configuration and number of samples, at least 2
    int levels = 8;  ///< numbers of samples: 1, 2, 4, ...
    uint32_t firstSeed = 0;
    double timeLimit = 0.0;  ///< seconds of rendering in all, shared evenly by the configurations; 0: no limit
    ErrorMeasure measure = ErrorMeasure::relative;
};

/// Samples of a level, counted from 0.
constexpr uint32_t samplesOfLevel(int level) { return uint32_t{1} << level; }

/// A point's seed: no two points of a configuration share random numbers, so that their errors are independent;
/// configurations share them, so that their difference is not one of luck.
uint32_t seedOfPoint(const ChartPlan& plan, int level, int repeat);

/// A point that was just measured.
struct ChartShot {
    size_t config = 0;
    int level = 0;
    int repeat = 0;
    Bitmap image;
};

/// Seeds of one configuration and number of samples of which some are still to come.
struct PartialSeeds {
    std::string config;
    uint32_t samples = 0;
    SeedImages images;
};

/// Measures a chart point by point: level by level, within a level seed by seed, within a seed all configurations,
/// every second time in reverse, so that a machine that drifts favours none. Of each configuration a first rendering of
/// one sample is not counted. A configuration whose next level would take it beyond its share of the time limit ends;
/// the first level is measured always, unless a single rendering of it outlasts the share.
class ChartRun {
public:
    /// `references`: of each configuration, which must outlive the run, as the scene must. The scene's environment must
    /// not be settled.
    ChartRun(Device& device, const Scene& scene, ChartPlan plan, std::vector<const Reference*> references);

    /// Takes points that were measured before; of seeds without all of their images and without a partial sum, the
    /// points are dropped. Call before next().
    void resume(const ChartTable& table, std::vector<PartialSeeds> partials);

    /// Measures the next point. Nothing where all is done, or where `stop`, asked between dispatches, says so.
    std::optional<ChartShot> next(const std::function<bool()>& stop);

    const ChartTable& table() const { return table_; }
    const std::vector<PartialSeeds>& partials() const { return partials_; }
    /// Points measured, over points that are still thought possible.
    double fractionDone() const;
    /// Configurations that ended early by the time limit, with their last level + 1.
    const std::vector<int>& levelLimits() const { return levelLimits_; }
    /// Seconds to build, upload and compile a configuration; nothing where none of its points was measured by this run.
    const std::vector<std::optional<RenderTimes>>& setupTimes() const { return setupTimes_; }

private:
    struct Place {
        int level, repeat;
        size_t config;
    };

    std::optional<Place> nextPlace();
    bool isMeasured(const Place& place) const;
    /// The first with the samples that the configuration takes at least.
    int firstLevelOf(size_t config) const;
    bool fitsTimeLimit(size_t config, int level) const;
    double secondsOf(size_t config, int level) const;
    Renderer& rendererOf(size_t config, const std::function<bool()>& stop);
    bool render(Renderer& renderer, uint32_t seed, uint32_t samples, double limit, const std::function<bool()>& stop);
    void addPoint(const Place& place, Renderer& renderer, const Bitmap& image);
    void addImage(const Place& place, const Bitmap& image);

    Device& device_;
    const Scene& scene_;
    ChartPlan plan_;
    std::vector<const Reference*> references_;
    ChartTable table_;
    std::vector<PartialSeeds> partials_;
    std::vector<int> levelLimits_;
    std::vector<std::optional<RenderTimes>> setupTimes_;
    std::vector<std::unique_ptr<Renderer>> renderers_;
    std::vector<size_t> recentlyUsed_;  ///< renderers, the latest at the end
};

}  // namespace raylab
