#include <iostream>
#include <map>

#include "engine/accel/bvh_cache.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/measure/scene_hash.h"
#include "engine/scene/import.h"
#include "ui/cli/chart_configs.h"
#include "ui/cli/chart_files.h"
#include "ui/cli/chart_output.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/options.h"
#include "ui/cli/progress.h"

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

/// The references of a chart, each rendered or read once.
class References {
public:
    References(Device& device, const Scene& scene, const ChartOptions& options)
        : device_(device), scene_(scene), options_(options) {}

    /// Nothing where the user interrupts.
    const Reference* of(const RenderSettings& settings) {
        const bool isFile = options_.reference != "path" && options_.reference != "own";
        const RenderSettings wanted =
            referenceSettings(settings, options_.reference == "own" ? ReferenceKind::own : ReferenceKind::path);
        const std::string key = isFile ? std::to_string(settings.width) + "x" + std::to_string(settings.height)
                                       : settingsJson(wanted).dump();
        if (const auto found = known_.find(key); found != known_.end()) return &found->second;
        std::optional<Reference> reference =
            isFile
                ? readReference(options_.reference, static_cast<int>(settings.width), static_cast<int>(settings.height))
                : render(wanted);
        return reference ? &known_.emplace(key, std::move(*reference)).first->second : nullptr;
    }

private:
    std::optional<Reference> render(const RenderSettings& settings) {
        logInfo("reference: " + options_.reference + ", to a relative error of " +
                settingText(options_.referenceError));
        Progress progress(options_.quiet);
        return obtainReference(device_, scene_, settings, options_.referenceError, referenceFolder(),
                               InterruptGuard::isInterrupted, [&](double done) { progress.show(done, 0, -1.0); });
    }

    Device& device_;
    const Scene& scene_;
    const ChartOptions& options_;
    std::map<std::string, Reference> known_;
};

/// What tells one choice of reference from another: a file by its bytes.
std::string referenceIdentity(const std::string& choice) {
    if (choice == "path" || choice == "own") return choice;
    const Hash128 hash = hashBytes(readFile(choice));
    return "file " + std::to_string(hash.high) + " " + std::to_string(hash.low);
}

Chart makeChart(const ChartOptions& options, const RenderSettings& base, const Scene& scene,
                const DeviceDescription& device) {
    Chart chart;
    chart.folder = options.folder;
    chart.scene = options.scene;
    chart.sceneHash = sceneHash(scene);
    chart.device = device.name;
    chart.referenceChoice = referenceIdentity(options.reference);
    chart.referenceError = options.referenceError;
    chart.targetError = base.targetError;
    chart.plan = {.configs = chartConfigs(base, options.request, device),
                  .seeds = options.seeds,
                  .levels = options.levels,
                  .firstSeed = static_cast<uint32_t>(base.seed),
                  .timeLimit = base.timeLimit,
                  .measure = parseErrorMeasure(options.error)};
    return chart;
}

/// Measures until all is done or the user interrupts; the table on disk follows each point.
void measure(ChartRun& run, Chart& chart, bool quiet) {
    Progress progress(quiet);
    while (const std::optional<ChartShot> shot = run.next(InterruptGuard::isInterrupted)) {
        chart.table = run.table();
        analyse(chart);
        writeChartCsv(chart);
        if (shot->repeat == 0) writePictures(chart, *shot);
        progress.show(run.fractionDone(), samplesOfLevel(shot->level), -1.0);
    }
    chart.table = run.table();
    chart.levelLimits = run.levelLimits();
    chart.setupTimes = run.setupTimes();
    chart.isInterrupted = InterruptGuard::isInterrupted();
    analyse(chart);
}

ExitCode chartScene(const ChartOptions& options) {
    setQuiet(options.quiet);
    const RenderSettings base = options.settings.resolve();
    requireReadableFile(scenePath(options.scene));
    requireWritable(std::filesystem::path(options.folder) / "chart.csv");
    Device device({base.device, base.validation});
    const Scene scene = importScene(scenePath(options.scene));
    for (const std::string& warning : scene.warnings) logWarning(warning);
    Chart chart = makeChart(options, base, scene, device.description());
    const std::optional<EarlierChart> earlier = loadEarlier(chart);

    const InterruptGuard guard;
    References references(device, scene, options);
    for (const ChartConfig& config : chart.plan.configs) {
        const Reference* reference = references.of(config.settings);
        if (reference == nullptr) throw Error("interrupted while the reference was rendered; nothing was measured yet");
        chart.references.push_back(reference);
    }
    ChartRun run(device, scene, chart.plan, chart.references);
    if (earlier) run.resume(earlier->table, earlier->partials);
    writeChartJson(chart);
    measure(run, chart, options.quiet);
    writePartials(chart, run.partials());
    writeChartCsv(chart);
    writeChartOutput(chart);
    printChart(chart);
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
