#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "engine/measure/advise.h"

namespace raylab {

/// One rendering of a probe takes about so long, and has so many samples at most.
constexpr double kProbeSeconds = 0.25;
constexpr uint32_t kMostProbeSamples = 256;
constexpr int kProbeSeeds = 4;
/// An adaptive rendering is measured with no fewer samples: its pilot is one of that many.
constexpr uint32_t kLeastAdaptive = 16;

/// A rendering with so many samples, denoised: by one seed, or by all.
struct DenoisedLevel {
    double samples = 0.0;
    double seconds = 0.0;
    double error = 0.0;
};

/// Where the goal is reached with a denoiser.
struct DenoisedForecast {
    std::vector<DenoisedLevel> seeds;  ///< by each alone; none where it is not reached in time
    DenoisedLevel all;
    double relativeBias = 0.0;
    double energy = 0.0;

    Forecast forecast() const { return {static_cast<uint32_t>(all.samples), all.seconds, all.error, relativeBias}; }
};

/// What settings come to at a goal, by short renderings whose seeds are never used twice. Nothing where `stop` says so.
class Forecaster {
public:
    Forecaster(Device& device, const Scene& scene, const Reference& reference, const AdviceGoal& goal,
               const std::function<bool()>& stop, uint32_t firstSeed)
        : device_(device), scene_(scene), reference_(reference), goal_(goal), stop_(stop), nextSeed_(firstSeed) {}

    /// Of kProbeSeconds, where a sample takes so long.
    uint32_t samplesFor(double sampleSeconds) const;
    /// The candidates side by side, each with so many samples, or more where one needs more.
    std::optional<std::vector<Probe>> measure(std::span<const RenderSettings> candidates, uint32_t samples, int seeds);
    std::optional<Forecast> forecast(const RenderSettings& settings);
    /// A denoiser's error falls neither as its samples' does nor as any power that is known, and its bias with it: measured
    /// with twice the samples each time, until the goal is passed, is out of sight or more than `mostSeconds` have gone.
    std::optional<DenoisedForecast> forecastDenoised(const RenderSettings& settings, double mostSeconds);
    std::optional<Achieved> run(const RenderSettings& settings);

private:
    std::optional<Forecast> forecastBySamples(const RenderSettings& settings);

    Device& device_;
    const Scene& scene_;
    const Reference& reference_;
    AdviceGoal goal_;
    const std::function<bool()>& stop_;
    uint32_t nextSeed_;
};

}  // namespace raylab
