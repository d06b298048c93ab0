#include "ui/report/advise_job.h"

#include "engine/core/log.h"
#include "engine/render/device_defaults.h"

namespace raylab {
namespace {

/// A reference may have half of the error that is judged by it: its noise is known, and taken off.
constexpr double kReferenceShare = 0.5;
constexpr double kReferenceErrorOfTime = 0.02;

double referenceErrorOf(double asked, const AdviceGoal& goal) {
    if (asked > 0.0) return asked;
    return goal.relativeError > 0.0 ? kReferenceShare * goal.relativeError : kReferenceErrorOfTime;
}

}  // namespace

std::optional<AdviceReport> runAdvice(Device& device, const std::string& sceneName, const Scene& scene,
                                      const RenderSettings& base, const AdviceGoal& goal, double referenceError,
                                      const AdviceWatch& watch) {
    AdviceReport report;
    report.scene = sceneName;
    report.device = device.description().name;
    report.goal = goal;
    report.base = resolveForDevice(base, device.description());
    report.base.timeLimit = report.base.targetError = 0.0;
    const double error = referenceErrorOf(referenceError, goal);
    logInfo("reference: path tracing to a relative error of " + settingText(error));
    std::optional<Reference> reference =
        obtainReference(device, scene, referenceSettings(report.base, ReferenceKind::path), error, referenceFolder(),
                        watch.stop, watch.onReference);
    if (!reference) return std::nullopt;
    report.reference = std::move(*reference);
    std::optional<Advice> advice =
        advise(device, scene, report.base, report.reference, report.goal, watch.stop, watch.onProgress);
    if (!advice) return std::nullopt;
    report.advice = std::move(*advice);
    watch.onProgress("lights");
    auto lights = lightShares(device, scene, report.advice.settings, report.reference, watch.stop);
    if (!lights) return std::nullopt;
    report.lights = std::move(*lights);
    report.textures = texturesBelowPixels(scene, report.base);
    return report;
}

}  // namespace raylab
