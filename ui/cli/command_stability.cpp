#include <iostream>

#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/render/device_recovery.h"
#include "ui/cli/commands.h"
#include "ui/cli/interrupt.h"
#include "ui/report/stability_output.h"
#include "ui/report/stability_plan.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

struct StabilityOptions {
    std::vector<std::string> cases;
    std::vector<std::string> configs{"default"};
    std::string output;
    std::string json;
    std::string csv;
    std::string scenes;
    std::string device;
    double timeLimit = 0.0;
    bool quick = false;
    bool validation = false;
    bool list = false;
    bool quiet = false;

    bool prints() const { return json != "-"; }
};

/// `--scenes`, or those that lie beside the source tree.
fs::path scenesFolder(const std::string& given) {
    if (given.empty()) return sharedScenes();
    if (!fs::is_directory(given)) throw Error("--scenes " + given + " is no folder");
    return given;
}

void requireFiles(const StabilityOptions& options) {
    for (const std::string& id : options.cases) stability::casesOf(id);
    if (!options.csv.empty()) requireWritable(options.csv);
    if (!options.json.empty() && options.json != "-") requireWritable(options.json);
    if (!options.output.empty()) requireWritable(fs::path(options.output) / "stability.html");
}

void listCases() {
    std::string last;
    for (const stability::Case& each : stability::cases()) {
        std::cout << (each.id == last ? std::string(6, ' ')
                                      : std::string(each.id) + std::string(6 - each.id.size(), ' '))
                  << each.provokes << "\n";
        last = each.id;
    }
}

ExitCode runStability(const StabilityOptions& options) {
    setQuiet(options.quiet || !options.prints());
    if (options.list) {
        listCases();
        return ExitCode::done;
    }
    requireFiles(options);
    const fs::path scenes = scenesFolder(options.scenes);
    ReplaceableDevice device({options.device, options.validation});
    const stability::Plan plan = stabilityPlan(options.cases, options.configs, device.get().description());
    const InterruptGuard guard;
    const Stopwatch watch;
    const auto goesOn = [&] {
        return !InterruptGuard::isInterrupted() && (options.timeLimit <= 0.0 || watch.seconds() < options.timeLimit);
    };
    const auto replaceDevice = [&] {
        device.replace();
        return &device.get();
    };
    const stability::Context context{device.get(), {},           options.quick, scenes, executableFolder() / "raylab",
                                     goesOn,       replaceDevice};
    StabilityRun run{device.get().description(), options.quick, 0.0, {}};
    run.result =
        stability::runBattery(plan, context, [&](const auto&, const auto&, std::span<const stability::Row> rows) {
            if (options.prints())
                for (const stability::Row& row : rows) std::cout << rowLine(row) << std::endl;
        });
    run.seconds = watch.seconds();
    if (options.prints()) printSummary(run);
    if (!options.csv.empty()) writeStabilityCsv(options.csv, run);
    if (!options.json.empty()) writeJson(options.json, stabilityJson(run));
    if (!options.output.empty()) writeStabilityHtml(options.output, run);
    return run.defaultFailures() > 0 || device.validationMessageCount() > 0 ? ExitCode::checkFailed : ExitCode::done;
}

}  // namespace

void addStabilityCommand(CLI::App& app, Command& chosen) {
    CLI::App* command =
        app.add_subcommand("stability", "where ray tracing fails: a number for each failure, by configuration");
    const auto options = std::make_shared<StabilityOptions>();
    command->add_option("--case", options->cases, "ids of cases; without: all (--list names them)")
        ->type_name("S1,S4")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        ->add_option("--configs", options->configs,
                     "what to measure: the default, and what differs from it in one setting; product: in several")
        ->delimiter(',')
        ->check(CLI::IsMember(stability::configSets()))
        ->allow_extra_args(false)
        ->capture_default_str();
    command->add_flag("--list", options->list, "name the cases and end");
    command->add_option("-o,--output", options->output, "folder for stability.html with a picture of each failure")
        ->type_name("DIR");
    command->add_option("--json", options->json, "write everything to a file, or - for standard output")
        ->type_name("FILE");
    command->add_option("--csv", options->csv, "write the rows as a table")->type_name("FILE");
    command->add_flag("--quick", options->quick, "a tenth of the rays, small images");
    command
        ->add_option("--scenes", options->scenes,
                     "folder of the scenes that are not raylab's own; without: ../shared/scenes of the source tree")
        ->type_name("DIR");
    command->add_option("--time-limit", options->timeLimit, "stop after so long and write what is there; 0: no limit")
        ->type_name("s")
        ->check(CLI::Range(0.0, 1e9));
    command->add_option("--device", options->device, "number or part of the name of a Vulkan device");
    command->add_flag("--validation", options->validation,
                      "Vulkan validation of the whole run; a message makes it fail");
    command->add_flag("--quiet", options->quiet, "warnings only, beside the table");
    command->footer("Exit code 1: the default configuration is beyond a limit.");
    command->callback([&chosen, options] { chosen = [options] { return runStability(*options); }; });
}

}  // namespace raylab
