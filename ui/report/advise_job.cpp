#include "ui/report/advise_job.h"

#include "engine/core/log.h"
#include "engine/render/device_defaults.h"

namespace raylab {
namespace {

/// A reference may have half of the error that is judged by it: its noise is known, and taken off. With as much error as
/// is asked, a bright pixel of it counts as bias of everything that is measured by it (seen on `lights`).
constexpr double kReferenceShare = 0.5;
constexpr double kReferenceErrorOfTime = 0.02;

double referenceErrorOf(double asked, const AdviceGoal& goal) {
    if (asked > 0.0) return asked;
    return goal.relativeError > 0.0 ? kReferenceShare * goal.relativeError : kReferenceErrorOfTime;
}

bool obtainReferenceOf(AdviceReport& report, Device& device, const Scene& scene, double error,
                       const AdviceWatch& watch) {
    if (!report.reference.image.mean.pixels.empty()) return true;
    logInfo("reference: path tracing to a relative error of " + settingText(error));
    std::optional<Reference> reference =
        obtainReference(device, scene, referenceSettings(report.base, ReferenceKind::path), error, referenceFolder(),
                        watch.stop, watch.onReference);
    if (reference) report.reference = std::move(*reference);
    return reference.has_value();
}

}  // namespace

bool runAdvice(Device& device, const std::string& sceneName, const Scene& scene, const RenderSettings& base,
               const AdviceGoal& goal, double referenceError, const AdviceWatch& watch, AdviceReport& report) {
    report.scene = sceneName;
    report.device = device.description().name;
    report.goal = goal;
    report.base = resolveForDevice(base, device.description(), scene);
    report.base.timeLimit = report.base.targetError = 0.0;
    if (!obtainReferenceOf(report, device, scene, referenceErrorOf(referenceError, goal), watch)) return false;
    if (!advise(device, scene, report.base, report.reference, report.goal, watch.stop, watch.onProgress, report.advice))
        return false;
    watch.onProgress("lights");
    auto lights = lightShares(device, scene, report.advice.settings, report.reference, watch.stop);
    if (!lights) return false;
    report.lights = std::move(*lights);
    report.textures = texturesBelowPixels(scene, report.base);
    report.isComplete = true;
    return true;
}

}  // namespace raylab
