#include "engine/measure/advise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/core/error.h"
#include "engine/measure/image_error.h"
#include "engine/measure/setting_effects.h"
#include "engine/render/denoise.h"
#include "engine/render/integrators.h"
#include "engine/render/renderer.h"
#include "engine/render/tracer.h"

namespace raylab {
namespace {

/// One rendering of a probe takes about so long, and has so many samples at most.
constexpr double kProbeSeconds = 0.25;
constexpr uint32_t kMostProbeSamples = 256;
constexpr int kProbeSeeds = 4;
/// That a step takes at most: a first look, the held settings alone, and the probes.
constexpr uint32_t kSeedsOfStep = 1 + 2 * kProbeSeeds;
/// A candidate this many times slower than the held value after two seeds is measured no longer.
constexpr double kHopeless = 3.0;
/// A gain that is less is not worth an unusual setting.
constexpr double kWorthwhile = 1.03;
/// Samples of the second measurement of a forecast, over those it forecasts.
constexpr double kCalibrationShare = 0.25;
/// Noise falls with a power of the samples: independent ones have 1, well-distributed ones more on smooth pixels.
constexpr double kLeastPower = 0.9, kMostPower = 1.5;

/// What an adaptive rendering gains shows in some part of the samples that the goal takes, and in no fewer than these:
/// its pilot is one of that many.
constexpr double kAdaptiveShare = 0.125;
constexpr uint32_t kLeastAdaptive = 16;
/// A denoiser is looked at with twice the samples each time: no further where the rate of the last two doublings does
/// not come to the goal within these.
constexpr uint32_t kMostDenoiseSamples = 1u << 20;
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
};

double medianSeconds(const Probe& probe, double error) {
    std::vector<double> seconds;
    for (size_t seed = 0; seed < probe.sampleSeconds.size(); ++seed)
        seconds.push_back(probe.secondsToError(error, seed));
    return medianOf(seconds);
}

/// The state of a search.
class Search {
public:
    Search(Device& device, const Scene& scene, const Reference& reference, const AdviceGoal& goal,
           const std::function<bool()>& stop, size_t stepsBefore)
        : device_(device),
          scene_(scene),
          reference_(reference),
          goal_(goal),
          stop_(stop),
          nextSeed_(1 + kSeedsOfStep * static_cast<uint32_t>(stepsBefore)) {}

    /// Of the values of a coordinate; false where it was stopped. `held` gets the chosen value, `steps` what was found.
    bool tryCoordinate(const Coordinate& coordinate, RenderSettings& held, std::vector<AdviceStep>& steps);
    /// The denoisers, against what the held settings come to without one.
    bool tryDenoisers(RenderSettings& held, std::vector<AdviceStep>& steps, Forecast& forecast);
    std::optional<Forecast> forecast(const RenderSettings& settings);
    std::optional<Achieved> run(const RenderSettings& settings);

private:
    std::optional<std::vector<Probe>> measure(std::span<const RenderSettings> candidates, uint32_t samples, int seeds) {
        ProbePlan plan;
        plan.samples = samples;
        for (const RenderSettings& candidate : candidates)
            plan.samples = std::max(plan.samples, leastSamples(candidate));
        plan.seeds = seeds;
        plan.firstSeed = nextSeed_;
        plan.hopeless = kHopeless;
        nextSeed_ += static_cast<uint32_t>(seeds);
        return probe(device_, scene_, candidates, reference_, plan, stop_);
    }
    uint32_t samplesFor(double sampleSeconds) const {
        return static_cast<uint32_t>(std::clamp(kProbeSeconds / sampleSeconds, 1.0, double{kMostProbeSamples}));
    }
    uint32_t samplesOf(const Coordinate& coordinate) const {
        const uint32_t usual = samplesFor(sampleSeconds_);
        if (coordinate.setting != std::string_view(kAdaptive)) return usual;
        const double share = std::min(kAdaptiveShare * wantedSamples_, double{kMostProbeSamples});
        return std::max({usual, kLeastAdaptive, static_cast<uint32_t>(share)});
    }
    bool lookAtHeld(const RenderSettings& held, bool needsWanted);
    void noteHeld(const Probe& probe) {
        sampleSeconds_ = probe.medianSampleSeconds();
        wantedSamples_ = (medianSeconds(probe, errorForNoise(probe)) - probe.buildSeconds) / sampleSeconds_;
    }
    std::optional<Forecast> forecastBySamples(const RenderSettings& settings);
    std::optional<DenoisedForecast> forecastDenoised(const RenderSettings& settings, double mostSeconds);
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

    Device& device_;
    const Scene& scene_;
    const Reference& reference_;
    AdviceGoal goal_;
    const std::function<bool()>& stop_;
    uint32_t nextSeed_;
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
        const auto first = measure(one, 1, 1);
        if (!first) return false;
        sampleSeconds_ = first->front().medianSampleSeconds();
    }
    if (needsWanted && wantedSamples_ == 0.0) {
        const auto probes = measure(one, samplesFor(sampleSeconds_), kProbeSeeds);
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
    auto probes = measure(candidates, samplesOf(coordinate), kProbeSeeds);
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

/// From two numbers of samples: a short one, and one of some share of what is forecast.
std::optional<Forecast> Search::forecastBySamples(const RenderSettings& settings) {
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

/// A denoiser's error falls neither as its samples' does nor as any power that is known, and its bias with it: measured
/// with twice the samples each time, until the goal is passed, is out of sight or more than `mostSeconds` have gone.
std::optional<DenoisedForecast> Search::forecastDenoised(const RenderSettings& settings, double mostSeconds) {
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

Forecast forecastOf(const DenoisedForecast& found) {
    return {static_cast<uint32_t>(found.all.samples), found.all.seconds, found.all.error, found.relativeBias};
}

std::optional<Forecast> Search::forecast(const RenderSettings& settings) {
    if (settings.denoise == kNoDenoiser) return forecastBySamples(settings);
    const auto found = forecastDenoised(settings, std::numeric_limits<double>::infinity());
    if (!found) return std::nullopt;
    return forecastOf(*found);
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
            const auto found = forecastDenoised(candidate, std::max(plain.seconds, goal_.seconds));
            if (!found) return false;
            const Interval gain = gainOverPlain(*found, plain);
            if (&candidate != &candidates.front() && gain.value <= option.gain.value) continue;
            option = {name, gain, found->relativeBias, found->energy};
            if (!isWorthwhile(option)) continue;
            step.chosen = name;
            best = candidate;
            forecast = forecastOf(*found);
        }
        step.options.push_back(std::move(option));
    }
    if (best.adaptive != held.adaptive) adaptive->chosen = "off";
    held = best;
    steps.push_back(std::move(step));
    return true;
}

std::optional<Achieved> Search::run(const RenderSettings& settings) {
    const std::vector<RenderSettings> one{settings};
    const auto probes = measure(one, static_cast<uint32_t>(settings.spp), 1);
    if (!probes) return std::nullopt;
    const Probe& only = probes->front();
    return Achieved{only.sampleSeconds.front() * only.samples, std::sqrt(std::max(0.0, only.squaredErrors.front()))};
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
    Search search(device, scene, reference, goal, stop, advice.steps.size());
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
    std::optional<Forecast> forecast = search.forecast(settings);
    while (forecast && forecast->samples == 0 && takeBackBiased(advice, forecast->relativeBias))
        forecast = search.forecast(settings);
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
    const std::optional<Forecast> standard = isAsBefore ? forecast : search.forecast(base);
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
    const std::optional<Achieved> achieved = search.run(advice.settings);
    if (!achieved) return false;
    advice.forecast = *forecast;
    advice.standard = *standard;
    advice.achieved = *achieved;
    return true;
}

}  // namespace raylab
