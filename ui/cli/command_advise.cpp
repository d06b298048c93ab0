#include <iostream>

#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/render/device_recovery.h"
#include "engine/scene/import.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/options.h"
#include "ui/cli/progress.h"
#include "ui/report/advise_job.h"

namespace raylab {
namespace {

struct AdviseOptions {
    explicit AdviseOptions(CLI::App& command) : settings(command) {}

    SettingOptions settings;
    std::string scene;
    std::string preset;
    std::string json;
    std::vector<std::string> only;
    double referenceError = 0.0;
    bool quiet = false;
};

AdviceGoal goalOf(const RenderSettings& settings) {
    if ((settings.targetError > 0.0) == (settings.timeLimit > 0.0))
        throw Error("give either --target-error, a relative error such as 0.05, or --time-limit, in seconds");
    return {settings.targetError, settings.timeLimit, {}};
}

/// After a loss it goes on from the last step on another device, as long as each of them brings a step; without, and
/// after Ctrl-C, the report is not complete.
AdviceReport makeReport(ReplaceableDevice& device, const Scene& scene, const RenderSettings& base,
                        const AdviseOptions& options) {
    AdviceGoal goal = goalOf(base);
    goal.only = options.only;
    Progress progress(options.quiet);
    const AdviceWatch watch{.stop = InterruptGuard::isInterrupted,
                            .onReference = [&](double done) { progress.show(done, 0, -1.0); },
                            .onProgress =
                                [&](const std::string& what) {
                                    progress.finish();
                                    logInfo(what);
                                }};
    AdviceReport report;
    for (std::optional<size_t> before;; device.replace()) {
        const std::vector<AdviceStep>& steps = report.advice.steps;
        try {
            runAdvice(device.get(), options.scene, scene, base, goal, options.referenceError, watch, report);
            progress.finish();
            return report;
        } catch (const DeviceLost& loss) {
            progress.finish();
            if (before == steps.size()) {
                report.deviceLoss = loss.what();
                return report;
            }
            logWarning("the device was lost (" + std::string(loss.what()) + "). " + std::to_string(steps.size()) +
                       " steps are kept; the search goes on from there on a fresh device");
        }
        before = steps.size();
    }
}

Error endedEarly(const AdviceReport& report) {
    const std::string kept = "; the steps before (" + std::to_string(report.advice.steps.size()) +
                             ") are kept, but nothing was forecast, so there is no preset";
    if (report.deviceLoss.empty()) return Error("interrupted" + kept, kInterrupted);
    return Error(report.deviceLoss + kept + ": --only searches without what lost the device", ExitCode::noDevice);
}

ExitCode adviseScene(const AdviseOptions& options) {
    setQuiet(options.quiet);
    const RenderSettings base = options.settings.resolve();
    goalOf(base);
    requireReadableFile(scenePath(options.scene));
    if (!options.preset.empty()) requireWritable(options.preset);
    if (!options.json.empty() && options.json != "-") requireWritable(options.json);
    ReplaceableDevice device({base.device, base.validation});
    const Scene scene = importScene(scenePath(options.scene));
    for (const std::string& warning : scene.warnings) logWarning(warning);
    const InterruptGuard guard;
    const AdviceReport report = makeReport(device, scene, base, options);
    if (report.isComplete && !options.preset.empty()) writeJson(options.preset, presetJson(report));
    if (!options.json.empty()) writeJson(options.json, adviceJson(report));
    if (options.json != "-") printAdvice(report);
    if (!report.isComplete) throw endedEarly(report);
    return device.validationMessageCount() > 0 ? ExitCode::checkFailed : ExitCode::done;
}

}  // namespace

void addAdviseCommand(CLI::App& app, Command& chosen) {
    CLI::App* command =
        app.add_subcommand("advise", "the cheapest settings for an error or a time, by a short measured search");
    const auto options = std::make_shared<AdviseOptions>(*command);
    command->add_option("scene", options->scene, "glTF, GLB, OBJ, PLY or STL; or the name of a scene of raylab's own")
        ->required();
    command->add_option("-o,--output", options->preset, "JSON file for --preset")->type_name("FILE");
    command->add_option("--json", options->json, "write all that was measured to a file, or - for standard output")
        ->type_name("FILE");
    command
        ->add_option("--reference-error", options->referenceError,
                     "relative error of the reference; 0: half of the target")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command->add_option("--only", options->only, "settings to search; without: all")
        ->delimiter(',')
        ->check(CLI::IsMember(adviceSettings()));
    command->add_flag("--quiet", options->quiet, "no progress; warnings only");
    command->callback([&chosen, options] { chosen = [options] { return adviseScene(*options); }; });
}

}  // namespace raylab
