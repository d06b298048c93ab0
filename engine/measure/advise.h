#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/measure/probe.h"
#include "engine/measure/statistics.h"

namespace raylab {

/// What a rendering is to come to: one of the two numbers is 0.
struct AdviceGoal {
    double relativeError = 0.0;
    double seconds = 0.0;
    std::vector<std::string> only;  ///< settings that are searched, of adviceSettings(); empty: all
};

/// Settings that a search tries values of, in its order.
std::vector<std::string> adviceSettings();

/// A value of a setting, against the one that was held when it was tried.
struct AdviceOption {
    std::string value;
    Interval gain;  ///< seconds to the goal's error with the held value over those with this one; 0: never there
    /// Root of the squared bias where it is one, of settings that can change what a picture converges to.
    double relativeBias = 0.0;
    double energy = 0.0;        ///< of the picture, over the reference's
    double buildSeconds = 0.0;
};

/// Whether its gain is one with 95 % confidence, and enough for an unusual setting.
bool isWorthwhile(const AdviceOption& option);

/// One setting's turn.
struct AdviceStep {
    std::string setting;
    std::string held;                   ///< value before
    std::string chosen;                 ///< value after: another only where it is worthwhile
    std::vector<AdviceOption> options;  ///< the held value is the first
};

/// What a configuration will take, by measurements at two numbers of samples, or more where it is denoised.
struct Forecast {
    uint32_t samples = 0;
    double seconds = 0.0;  ///< of the device, for rendering
    double relativeError = 0.0;
    double relativeBias = 0.0;
};

/// What a run then took.
struct Achieved {
    double seconds = 0.0;
    double relativeError = 0.0;  ///< without the reference's noise
};

struct Advice {
    RenderSettings settings;  ///< spp included
    std::vector<AdviceStep> steps;
    Forecast forecast;
    Forecast standard;  ///< of the settings that the search began with; samples 0: they never reach the error
    /// What the steps chose is forecast to be no better than that, so that those settings are advised.
    bool isStandard = false;
    Achieved achieved;
};

/// Where a search stands, for the user who waits.
using AdviceProgress = std::function<void(const std::string& what)>;

/// Finds the settings that reach the goal soonest on this scene and device by coordinate search: depth, integrator,
/// choice of lights, sampler, roulette, tracer, layout, builder and adaptive samples in turn, each value measured beside
/// the one that is held, without a denoiser: those that converge to the same picture by their noise alone. Then forecasts, and
/// where depth or integrator turn out to have a bias that keeps them from the goal, goes to the next best; tries the
/// denoisers against that, and runs once to see whether it was right. `advice` follows each step, and a search goes on
/// from the steps that it holds: after a loss of the device, on another one. False where `stop` says so. Throws Error
/// where nothing that was tried reaches the error. `base` must be resolved for the device; the scene's environment must
/// not be settled.
bool advise(Device& device, const Scene& scene, const RenderSettings& base, const Reference& reference,
            const AdviceGoal& goal, const std::function<bool()>& stop, const AdviceProgress& progress, Advice& advice);

}  // namespace raylab
