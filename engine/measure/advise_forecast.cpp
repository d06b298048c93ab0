#include "engine/measure/advise_forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/render/denoise.h"
#include "engine/render/renderer.h"

namespace raylab {
namespace {

/// A candidate this many times slower than the held value after two seeds is measured no longer.
constexpr double kHopeless = 3.0;
/// Samples of the second measurement of a forecast, over those it forecasts.
constexpr double kCalibrationShare = 0.25;
/// Noise falls with a power of the samples: independent ones have 1, well-distributed ones more on smooth pixels.
constexpr double kLeastPower = 0.9, kMostPower = 1.5;
/// A denoiser is looked at with twice the samples each time: no further where the rate of the last two doublings does
/// not come to the goal within these.
constexpr uint32_t kMostDenoiseSamples = 1u << 20;

/// Errors that the reference's own noise hides count as large as that, and as one in a million at least.
double leastError(const Reference& reference) { return std::max(reference.relativeError, 1e-6); }

DenoisedLevel levelOf(const Probe& probe, double leastError) {
    return {static_cast<double>(probe.samples), probe.medianSampleSeconds() * probe.samples,
            std::max(probe.rmsError(), leastError)};
}

DenoisedLevel levelOf(const Probe& probe, size_t seed, double leastError) {
    return {static_cast<double>(probe.samples), probe.sampleSeconds[seed] * probe.samples,
            std::max(std::sqrt(std::max(0.0, probe.squaredErrors[seed])), leastError)};
}

/// Whether the error would pass the goal within kMostDenoiseSamples if it fell on as from one level to the next.
bool isHeadedFor(double goal, const DenoisedLevel& low, const DenoisedLevel& high) {
    const double power = std::log(low.error / high.error) / std::log(high.samples / low.samples);
    return high.error <= goal * std::pow(kMostDenoiseSamples / high.samples, power);
}

/// Between two levels: the time along a line, the error along a power of the samples. The higher one where the error
/// asked is not between theirs.
DenoisedLevel whereGoalIs(const AdviceGoal& goal, const DenoisedLevel& low, const DenoisedLevel& high) {
    const double perSample = (high.seconds - low.seconds) / (high.samples - low.samples);
    const double power = std::log(low.error / high.error) / std::log(high.samples / low.samples);
    double samples = high.samples;
    if (goal.relativeError == 0.0)
        samples = low.samples + (goal.seconds - low.seconds) / perSample;
    else if (low.error > goal.relativeError && high.error < goal.relativeError)
        samples = low.samples * std::pow(low.error / goal.relativeError, 1.0 / power);
    samples = std::clamp(std::ceil(samples), low.samples, high.samples);
    return {samples, low.seconds + (samples - low.samples) * perSample,
            low.error * std::pow(low.samples / samples, power)};
}

}  // namespace

uint32_t Forecaster::samplesFor(double sampleSeconds) const {
    return static_cast<uint32_t>(std::clamp(kProbeSeconds / sampleSeconds, 1.0, double{kMostProbeSamples}));
}

std::optional<std::vector<Probe>> Forecaster::measure(std::span<const RenderSettings> candidates, uint32_t samples,
                                                      int seeds) {
    ProbePlan plan;
    plan.samples = samples;
    for (const RenderSettings& candidate : candidates) plan.samples = std::max(plan.samples, leastSamples(candidate));
    plan.seeds = seeds;
    plan.firstSeed = nextSeed_;
    plan.hopeless = kHopeless;
    nextSeed_ += static_cast<uint32_t>(seeds);
    return probe(device_, scene_, candidates, reference_, plan, stop_);
}

/// From two numbers of samples: a short one, and one of some share of what is forecast.
std::optional<Forecast> Forecaster::forecastBySamples(const RenderSettings& settings) {
    const std::vector<RenderSettings> one{settings};
    const uint32_t least = settings.adaptive ? kLeastAdaptive : 1;
    const auto first = measure(one, least, 1);
    if (!first) return std::nullopt;
    const uint32_t fewSamples = std::max(least, samplesFor(first->front().medianSampleSeconds()));
    const auto few = measure(one, fewSamples, kProbeSeeds);
    if (!few) return std::nullopt;
    const Probe& low = few->front();
    const double aim = goal_.relativeError * goal_.relativeError;
    double wanted = goal_.seconds / low.medianSampleSeconds();
    if (goal_.relativeError > 0.0) {
        const double room = aim - low.biasSquared();
        if (room <= 0.0) return Forecast{0, 0.0, 0.0, std::sqrt(low.biasSquared())};
        wanted = low.sampleVariance() / room;
    }
    const auto manySamples = std::max(2 * fewSamples, static_cast<uint32_t>(std::min(wanted * kCalibrationShare, 1e6)));
    const auto many = measure(one, manySamples, kProbeSeeds);
    if (!many) return std::nullopt;
    const Probe& high = many->front();
    const double bias = high.biasSquared(), variance = high.sampleVariance() / manySamples;
    const double before = low.sampleVariance() / fewSamples;
    double power = 1.0;
    if (variance > 0.0 && before > 0.0)
        power = std::clamp(std::log(before / variance) / std::log(double(manySamples) / fewSamples), kLeastPower,
                           kMostPower);
    double samples = std::floor(goal_.seconds / high.medianSampleSeconds());
    if (goal_.relativeError > 0.0) {
        if (aim <= bias) return Forecast{0, 0.0, 0.0, std::sqrt(bias)};
        samples = std::ceil(manySamples * std::pow(variance / (aim - bias), 1.0 / power));
    }
    samples = std::clamp(samples, static_cast<double>(leastSamples(settings)), 4e9);
    const double error = std::sqrt(bias + variance * std::pow(manySamples / samples, power));
    return Forecast{static_cast<uint32_t>(samples), samples * high.medianSampleSeconds(), error, std::sqrt(bias)};
}

std::optional<DenoisedForecast> Forecaster::forecastDenoised(const RenderSettings& settings, double mostSeconds) {
    const std::vector<RenderSettings> one{settings};
    const double least = leastError(reference_);
    std::vector<Probe> levels;
    DenoisedForecast found;
    int timesAstray = 0;
    for (uint32_t samples = leastSamples(settings); samples <= kMostDenoiseSamples; samples *= 2) {
        const auto probes = measure(one, samples, kProbeSeeds);
        if (!probes) return std::nullopt;
        const Probe& now = levels.emplace_back(probes->front());
        const DenoisedLevel level = levelOf(now, least);
        found.relativeBias = std::sqrt(now.biasSquared());
        found.energy = now.energy;
        const bool isByError = goal_.relativeError > 0.0;
        const bool isLast = !isByError && samples * 2 > kMostDenoiseSamples;
        if (isLast || (isByError ? level.error <= goal_.relativeError : level.seconds > goal_.seconds)) {
            const Probe* const before = levels.size() > 1 ? &levels[levels.size() - 2] : nullptr;
            found.all = before ? whereGoalIs(goal_, levelOf(*before, least), level) : level;
            for (size_t seed = 0; seed < now.sampleSeconds.size(); ++seed) {
                const DenoisedLevel high = levelOf(now, seed, least);
                found.seeds.push_back(before ? whereGoalIs(goal_, levelOf(*before, seed, least), high) : high);
            }
            break;
        }
        if (level.seconds > mostSeconds) break;
        if (isByError && levels.size() > 1)
            timesAstray = isHeadedFor(goal_.relativeError, levelOf(levels[levels.size() - 2], least), level)
                              ? 0
                              : timesAstray + 1;
        if (timesAstray == 2) break;
    }
    return found;
}

std::optional<Forecast> Forecaster::forecast(const RenderSettings& settings) {
    if (settings.denoise == kNoDenoiser) return forecastBySamples(settings);
    const auto found = forecastDenoised(settings, std::numeric_limits<double>::infinity());
    if (!found) return std::nullopt;
    return found->forecast();
}

std::optional<Achieved> Forecaster::run(const RenderSettings& settings) {
    const std::vector<RenderSettings> one{settings};
    const auto probes = measure(one, static_cast<uint32_t>(settings.spp), 1);
    if (!probes) return std::nullopt;
    const Probe& only = probes->front();
    return Achieved{only.sampleSeconds.front() * only.samples, std::sqrt(std::max(0.0, only.squaredErrors.front()))};
}

}  // namespace raylab
