#include <optional>
#include <utility>

#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/render/device_recovery.h"
#include "engine/scene/import.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/options.h"
#include "ui/cli/progress.h"
#include "ui/report/chart_configs.h"
#include "ui/report/chart_job.h"
#include "ui/report/chart_output.h"

namespace raylab {
namespace {

struct ChartOptions {
    explicit ChartOptions(CLI::App& command) : settings(command) {}

    SettingOptions settings;
    std::string scene;
    std::string folder;
    ChartRequest request;
    int seeds = 4;
    int levels = 8;
    std::string error = "relative";
    std::string reference = "path";
    double referenceError = 0.01;
    bool quiet = false;
};

constexpr int kMostLevels = 24;

ChartOrder orderOf(const ChartOptions& options, const RenderSettings& base, const DeviceDescription& device,
                   const Scene& scene) {
    return {.scene = options.scene,
            .folder = options.folder,
            .configs = chartConfigs(base, options.request, device, scene),
            .seeds = options.seeds,
            .levels = options.levels,
            .firstSeed = static_cast<uint32_t>(base.seed),
            .timeLimit = base.timeLimit,
            .targetError = base.targetError,
            .measure = parseErrorMeasure(options.error),
            .reference = options.reference,
            .referenceError = options.referenceError};
}

/// After a loss it goes on from the folder on another device, as long as each but the first brings points.
Chart chartDespiteLosses(ReplaceableDevice& device, const Scene& scene, const ChartOrder& order,
                         const ChartWatch& watch) {
    Chart chart = runChart(device.get(), scene, order, watch);
    for (std::optional<size_t> before; !chart.deviceLoss.empty() && before != chart.table.points.size();) {
        before = chart.table.points.size();
        logWarning("the device was lost (" + chart.deviceLoss + "). " + std::to_string(*before) +
                   " points are kept; the chart goes on from there on a fresh device");
        device.replace();
        chart = runChart(device.get(), scene, order, watch);
    }
    return chart;
}

ExitCode chartScene(const ChartOptions& options) {
    setQuiet(options.quiet);
    const RenderSettings base = options.settings.resolve();
    requireReadableFile(scenePath(options.scene));
    requireWritable(std::filesystem::path(options.folder) / "chart.csv");
    ReplaceableDevice device({base.device, base.validation});
    const Scene scene = importScene(scenePath(options.scene));
    for (const std::string& warning : scene.warnings) logWarning(warning);
    const ChartOrder order = orderOf(options, base, device.get().description(), scene);
    const InterruptGuard guard;
    std::optional<Progress> progress(options.quiet);
    bool isMeasuring = false;
    const auto onPoint = [&](const Chart&, const ChartShot& shot, double done) {
        if (!std::exchange(isMeasuring, true)) progress.emplace(options.quiet);  // a clock of its own
        progress->show(done, samplesOfLevel(shot.level), -1.0);
    };
    const Chart chart = chartDespiteLosses(device, scene, order,
                                           {.stop = InterruptGuard::isInterrupted,
                                            .onReference = [&](double done) { progress->show(done, 0, -1.0); },
                                            .onPoint = onPoint});
    progress.reset();
    printChart(chart);
    if (!chart.deviceLoss.empty()) {
        logError(chart.deviceLoss + "; the " + std::to_string(chart.table.points.size()) + " points in " +
                 options.folder + " are kept, and the same command goes on from there");
        return ExitCode::noDevice;
    }
    return device.validationMessageCount() > 0 ? ExitCode::checkFailed : ExitCode::done;
}

}  // namespace

void addChartCommand(CLI::App& app, Command& chosen) {
    CLI::App* command =
        app.add_subcommand("chart", "error against time of several configurations, as table, chart and report");
    const auto options = std::make_shared<ChartOptions>(*command);
    command->add_option("scene", options->scene, "glTF, GLB, OBJ, PLY or STL; or the name of a scene of raylab's own")
        ->required();
    command
        ->add_option("-o,--output", options->folder,
                     "folder for the table, the chart and the report; with the same arguments it resumes what is there")
        ->type_name("FOLDER")
        ->required();
    command->add_option("--set-of", options->request.sets, "configurations to compare; repeated: several sets")
        ->check(CLI::IsMember(chartSetNames()))
        ->allow_extra_args(false);
    command->add_option("--vary", options->request.vary, "every value of a setting; repeated: every combination")
        ->type_name("NAME=A,B,C")
        ->allow_extra_args(false);
    command->add_option("--configs", options->request.file, "configurations with names and settings")
        ->type_name("FILE.json");
    command->add_option("--seeds", options->seeds, "renderings of each configuration and number of samples")
        ->check(CLI::Range(2, 1000))
        ->capture_default_str();
    command
        ->add_option("--points", options->levels,
                     "numbers of samples at most: 1, 2, 4, ...; --time-limit may end before")
        ->check(CLI::Range(1, kMostLevels))
        ->capture_default_str();
    command->add_option("--error", options->error, "what is charted: sqrt(relMSE), RMSE or FLIP")
        ->check(CLI::IsMember(errorMeasureNames()))
        ->capture_default_str();
    command
        ->add_option("--reference", options->reference,
                     "path: path tracing without shortcuts; own: each method itself; or an image of linear radiance")
        ->type_name("path|own|FILE")
        ->capture_default_str();
    command->add_option("--reference-error", options->referenceError, "relative error that a reference is rendered to")
        ->check(CLI::Range(1e-5, 1.0))
        ->capture_default_str();
    command->add_flag("--quiet", options->quiet, "no progress; warnings only");
    command->callback([&chosen, options] { chosen = [options] { return chartScene(*options); }; });
}

}  // namespace raylab
