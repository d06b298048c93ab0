#include "engine/measure/advise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/core/error.h"
#include "engine/measure/advise_forecast.h"
#include "engine/measure/setting_effects.h"
#include "engine/render/denoise.h"
#include "engine/render/integrators.h"
#include "engine/render/tracer.h"

namespace raylab {
namespace {

/// That a step takes at most: a first look, the held settings alone, and the probes.
constexpr uint32_t kSeedsOfStep = 1 + 2 * kProbeSeeds;
/// A gain that is less is not worth an unusual setting.
constexpr double kWorthwhile = 1.03;
/// Of the samples that the goal takes, what an adaptive rendering is tried with, where that is no fewer than kLeastAdaptive.
constexpr double kAdaptiveShare = 0.125;
constexpr const char* kAdaptive = "adaptive";
constexpr const char* kDenoise = "denoise";

struct Coordinate {
    const char* setting;
    std::vector<std::string> values;  ///< empty: all choices
};

const std::vector<Coordinate>& coordinates() {
    static const std::vector<Coordinate> list = {
        {"depth", {"2", "4", "8", "16", "32"}}, {"integrator", {}}, {"light-choice", {}}, {"sampler", {}},
        {"roulette-depth", {"1", "3", "8"}},    {"tracer", {}},     {"layout", {}},       {"builder", {}},
        {kAdaptive, {"off", "on"}}};
    return list;
}

bool isOffered(const std::string& setting, const std::string& value, const RenderSettings& held, const Device& device) {
    if (setting == "integrator") return !findIntegrator(value).isView;
    if (setting == "tracer") return value != "brute" && missingForTracer(value, device.description()).empty();
    if (setting == kAdaptive) return held.sampler != "stratified";
    if (setting == "sampler") return !held.adaptive || value != "stratified";
    if (setting == "layout" || setting == "builder") return held.tracer == "software" && value != kAutoLayout;
    return true;
}

/// The held value, then the others.
std::vector<std::string> valuesOf(const Coordinate& coordinate, const RenderSettings& held, const Device& device) {
    const Setting<RenderSettings>& setting = findSetting(renderSettingsTable(), coordinate.setting);
    const std::string now = settingText(getSetting(setting, held));
    std::vector<std::string> values{now};
    for (const std::string& value : coordinate.values.empty() ? setting.choices : coordinate.values)
        if (value != now && isOffered(coordinate.setting, value, held, device)) values.push_back(value);
    return values;
}

double medianSeconds(const Probe& probe, double error) {
    std::vector<double> seconds;
    for (size_t seed = 0; seed < probe.sampleSeconds.size(); ++seed)
        seconds.push_back(probe.secondsToError(error, seed));
    return medianOf(seconds);
}

/// The state of a search.
class Search {
public:
    Search(Forecaster& forecaster, const AdviceGoal& goal, const Device& device)
        : forecaster_(forecaster), goal_(goal), device_(device) {}

    /// Of the values of a coordinate; false where it was stopped. `held` gets the chosen value, `steps` what was found.
    bool tryCoordinate(const Coordinate& coordinate, RenderSettings& held, std::vector<AdviceStep>& steps);
    /// The denoisers, against what the held settings come to without one.
    bool tryDenoisers(RenderSettings& held, std::vector<AdviceStep>& steps, Forecast& forecast);

private:
    uint32_t samplesOf(const Coordinate& coordinate) const {
        const uint32_t usual = forecaster_.samplesFor(sampleSeconds_);
        if (coordinate.setting != std::string_view(kAdaptive)) return usual;
        const double share = std::min(kAdaptiveShare * wantedSamples_, double{kMostProbeSamples});
        return std::max({usual, kLeastAdaptive, static_cast<uint32_t>(share)});
    }
    bool lookAtHeld(const RenderSettings& held, bool needsWanted);
    void noteHeld(const Probe& probe) {
        sampleSeconds_ = probe.medianSampleSeconds();
        wantedSamples_ = (medianSeconds(probe, errorForNoise(probe)) - probe.buildSeconds) / sampleSeconds_;
    }
    Interval gainOverPlain(const DenoisedForecast& found, const Forecast& plain) const;
    /// The error that candidates are compared at.
    double errorFor(const Probe& held) const {
        return goal_.relativeError > 0.0 ? goal_.relativeError : held.errorAfter(goal_.seconds);
    }
    /// The error at which their noise is what the goal's error is, whatever their bias.
    double errorForNoise(const Probe& held) const {
        return goal_.relativeError > 0.0 ? std::hypot(goal_.relativeError, std::sqrt(held.biasSquared()))
                                         : held.errorAfter(goal_.seconds);
    }

    Forecaster& forecaster_;
    AdviceGoal goal_;
    const Device& device_;
    double sampleSeconds_ = 0.0;  ///< of the held settings
    double wantedSamples_ = 0.0;  ///< that they take to the goal
};

/// One estimate for all, of candidates that converge to the same picture.
void shareBias(std::vector<Probe>& probes) {
    BiasEstimate shared{0.0, 0.0, 0.0};
    const auto count = static_cast<double>(probes.size());
    for (const Probe& probe : probes) {
        shared.biasSquared += probe.bias.biasSquared / count;
        shared.standardError = std::hypot(shared.standardError, probe.bias.standardError / count);
    }
    for (Probe& probe : probes) {
        probe.bias.biasSquared = shared.biasSquared;
        probe.bias.standardError = shared.standardError;
    }
}

/// Paired by seed: both saw the same random numbers on a machine of the same mood. One without hope has fewer seeds.
Interval gainOf(const Probe& held, const Probe& other, double error) {
    std::vector<double> ratios;
    for (size_t seed = 0; seed < std::min(held.sampleSeconds.size(), other.sampleSeconds.size()); ++seed) {
        const double before = held.secondsToError(error, seed), after = other.secondsToError(error, seed);
        if (std::isinf(after)) return {0.0, 0.0, 0.0};
        ratios.push_back(std::isinf(before) ? std::numeric_limits<double>::infinity() : before / after);
    }
    if (std::isinf(ratios.front())) return {ratios.front(), ratios.front(), ratios.front()};
    return geometricInterval(ratios);
}

AdviceOption optionOf(const std::string& value, const Probe& held, const Probe& other, double error) {
    return {value, gainOf(held, other, error), std::sqrt(other.biasSquared()), other.energy, other.buildSeconds};
}

/// The fastest of those whose gain is one with confidence.
size_t choose(const std::vector<AdviceOption>& options, const std::vector<Probe>& probes, double error) {
    size_t best = 0;
    for (size_t i = 1; i < options.size(); ++i)
        if (isWorthwhile(options[i]) && medianSeconds(probes[i], error) < medianSeconds(probes[best], error)) best = i;
    return best;
}

/// What no step before has told of the held settings.
bool Search::lookAtHeld(const RenderSettings& held, bool needsWanted) {
    const std::vector<RenderSettings> one{held};
    if (sampleSeconds_ == 0.0) {
        const auto first = forecaster_.measure(one, 1, 1);
        if (!first) return false;
        sampleSeconds_ = first->front().medianSampleSeconds();
    }
    if (needsWanted && wantedSamples_ == 0.0) {
        const auto probes = forecaster_.measure(one, forecaster_.samplesFor(sampleSeconds_), kProbeSeeds);
        if (!probes) return false;
        noteHeld(probes->front());
    }
    return true;
}

bool Search::tryCoordinate(const Coordinate& coordinate, RenderSettings& held, std::vector<AdviceStep>& steps) {
    const std::vector<std::string> values = valuesOf(coordinate, held, device_);
    if (values.size() < 2) return true;
    const Setting<RenderSettings>& setting = findSetting(renderSettingsTable(), coordinate.setting);
    std::vector<RenderSettings> candidates(values.size(), held);
    for (size_t i = 0; i < values.size(); ++i) setSetting(setting, candidates[i], values[i]);
    const bool isAdaptive = coordinate.setting == std::string_view(kAdaptive);
    if (!lookAtHeld(held, isAdaptive)) return false;
    if (isAdaptive && wantedSamples_ < kLeastAdaptive) return true;  // its pilot would be more than the whole
    auto probes = forecaster_.measure(candidates, samplesOf(coordinate), kProbeSeeds);
    if (!probes) return false;
    const bool isSameMean = isNoiseSetting(coordinate.setting) || isSpeedSetting(coordinate.setting);
    if (isSameMean) shareBias(*probes);
    const double error = isSameMean ? errorForNoise(probes->front()) : errorFor(probes->front());
    AdviceStep step{coordinate.setting, values.front(), values.front(), {}};
    for (size_t i = 0; i < values.size(); ++i) {
        step.options.push_back(optionOf(values[i], probes->front(), (*probes)[i], error));
        if (isSameMean) step.options.back().relativeBias = 0.0;
    }
    const size_t best = choose(step.options, *probes, error);
    step.chosen = values[best];
    held = candidates[best];
    noteHeld((*probes)[best]);
    steps.push_back(std::move(step));
    return true;
}

/// At equal time the samples' noise would take the square of its ratio longer to fall as far.
Interval Search::gainOverPlain(const DenoisedForecast& found, const Forecast& plain) const {
    std::vector<double> gains;
    for (const DenoisedLevel& level : found.seeds)
        gains.push_back(goal_.relativeError > 0.0 ? plain.seconds / level.seconds
                                                  : std::pow(plain.relativeError / level.error, 2.0));
    return gains.empty() ? Interval{0.0, 0.0, 0.0} : geometricInterval(gains);
}

bool Search::tryDenoisers(RenderSettings& held, std::vector<AdviceStep>& steps, Forecast& forecast) {
    const Forecast plain = forecast;
    const auto adaptive = std::ranges::find(steps, kAdaptive, &AdviceStep::setting);
    AdviceStep step{kDenoise, held.denoise, held.denoise, {{held.denoise, {1.0, 1.0, 1.0}, plain.relativeBias, 1.0}}};
    RenderSettings best = held;
    for (const std::string& name : denoiserNames()) {
        if (name == step.held) continue;
        std::vector<RenderSettings> candidates{held};
        candidates.front().denoise = name;
        // The few samples that a denoised picture takes may be fewer than a pilot is worth.
        if (held.adaptive && adaptive != steps.end()) candidates.emplace_back(candidates.front()).adaptive = false;
        AdviceOption option{name, {0.0, 0.0, 0.0}};
        for (const RenderSettings& candidate : candidates) {
            const auto found = forecaster_.forecastDenoised(candidate, std::max(plain.seconds, goal_.seconds));
            if (!found) return false;
            const Interval gain = gainOverPlain(*found, plain);
            if (&candidate != &candidates.front() && gain.value <= option.gain.value) continue;
            option = {name, gain, found->relativeBias, found->energy};
            if (!isWorthwhile(option)) continue;
            step.chosen = name;
            best = candidate;
            forecast = found->forecast();
        }
        step.options.push_back(std::move(option));
    }
    if (best.adaptive != held.adaptive) adaptive->chosen = "off";
    held = best;
    steps.push_back(std::move(step));
    return true;
}

/// What may have brought a bias that short probes did not show gives way to the next best value: false where nothing of
/// it was chosen.
bool takeBackBiased(Advice& advice, double relativeBias) {
    bool isChanged = false;
    for (AdviceStep& step : advice.steps) {
        const bool mayBias = step.setting == "depth" || step.setting == "integrator";
        if (!mayBias || step.chosen == step.held) continue;
        const auto chosen = std::ranges::find(step.options, step.chosen, &AdviceOption::value);
        chosen->gain = {0.0, 0.0, 0.0};
        chosen->relativeBias = relativeBias;
        step.chosen = step.held;
        double most = 0.0;
        for (const AdviceOption& option : step.options)
            if (isWorthwhile(option) && option.gain.value > most) {
                most = option.gain.value;
                step.chosen = option.value;
            }
        setSetting(findSetting(renderSettingsTable(), step.setting), advice.settings, step.chosen);
        isChanged = true;
    }
    return isChanged;
}

}  // namespace

bool isWorthwhile(const AdviceOption& option) { return option.gain.low > 1.0 && option.gain.value > kWorthwhile; }

std::vector<std::string> adviceSettings() {
    std::vector<std::string> names;
    for (const Coordinate& coordinate : coordinates()) names.emplace_back(coordinate.setting);
    names.emplace_back(kDenoise);
    return names;
}

bool advise(Device& device, const Scene& scene, const RenderSettings& base, const Reference& reference,
            const AdviceGoal& goal, const std::function<bool()>& stop, const AdviceProgress& progress, Advice& advice) {
    Forecaster forecaster(device, scene, reference, goal, stop, 1 + kSeedsOfStep * static_cast<uint32_t>(advice.steps.size()));
    Search search(forecaster, goal, device);
    const auto isSearched = [&](std::string_view setting) {
        return goal.only.empty() || std::ranges::count(goal.only, setting) > 0;
    };
    const auto isDone = [&](std::string_view setting) {
        return std::ranges::count(advice.steps, setting, &AdviceStep::setting) > 0;
    };
    if (advice.steps.empty()) advice.settings = base;
    RenderSettings& settings = advice.settings;
    // The others are compared by their noise, which a denoiser hides.
    const bool triesDenoisers = isSearched(kDenoise) && !isDone(kDenoise);
    if (!isDone(kDenoise)) settings.denoise = kNoDenoiser;
    for (const Coordinate& coordinate : coordinates()) {
        if (!isSearched(coordinate.setting) || isDone(coordinate.setting)) continue;
        progress(coordinate.setting);
        if (!search.tryCoordinate(coordinate, settings, advice.steps)) return false;
    }
    if (!isSearched(kDenoise)) settings.denoise = base.denoise;
    progress("forecast");
    std::optional<Forecast> forecast = forecaster.forecast(settings);
    while (forecast && forecast->samples == 0 && takeBackBiased(advice, forecast->relativeBias))
        forecast = forecaster.forecast(settings);
    if (!forecast) return false;
    if (forecast->samples == 0)
        throw Error("nothing that was tried reaches a relative error of " + std::to_string(goal.relativeError) +
                    "; the least bias found is " + std::to_string(forecast->relativeBias) + ": ask for a larger error");
    if (triesDenoisers) {
        progress(kDenoise);
        if (!search.tryDenoisers(settings, advice.steps, *forecast)) return false;
    }
    const bool isAsBefore = base.denoise == settings.denoise &&
                            std::ranges::all_of(advice.steps, [](const AdviceStep& s) { return s.chosen == s.held; });
    const std::optional<Forecast> standard = isAsBefore ? forecast : forecaster.forecast(base);
    if (!standard) return false;
    // Each step's gain is an estimate, and few samples can be too few for what many would gain by.
    const bool isByError = goal.relativeError > 0.0;
    const bool isNoGain = isByError ? forecast->seconds > standard->seconds
                                    : forecast->relativeError > standard->relativeError;
    if (standard->samples > 0 && isNoGain) {
        settings = base;
        forecast = standard;
        advice.isStandard = true;
    }
    advice.settings.spp = forecast->samples;
    progress("verification");
    const std::optional<Achieved> achieved = forecaster.run(advice.settings);
    if (!achieved) return false;
    advice.forecast = *forecast;
    advice.standard = *standard;
    advice.achieved = *achieved;
    return true;
}

}  // namespace raylab
