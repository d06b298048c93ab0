#include <iostream>

#include "engine/core/file.h"
#include "engine/render/device_defaults.h"
#include "ui/cli/bench_output.h"
#include "ui/cli/commands.h"

namespace raylab {
namespace {

/// What can be wrong with the files is found before anything is measured.
void requireFiles(const BenchOptions& options) {
    for (const std::string& name : options.scenes) requireReadableFile(scenePath(name));
    if (!options.csv.empty()) requireWritable(options.csv);
    if (!options.json.empty() && options.json != "-") requireWritable(options.json);
}

ExitCode benchScenes(const BenchOptions& options) {
    const std::vector<RecordedRow> old =
        options.compare.empty() ? std::vector<RecordedRow>() : readBenchJson(options.compare);
    RenderSettings settings = options.settings.resolve();
    Device device({settings.device, settings.validation});
    const BenchPlan plan{.base = settings,
                         .variants = variantsOf(settings, options.vary),
                         .kinds = options.kinds,
                         .light = options.light,
                         .repeats = options.repeats,
                         .peers = !options.noPeers};
    BenchRun run{device, settings, options.repeats, measureHostMemory(), {}};
    const bool print = options.json != "-";
    if (print) printMemory(run);
    measureScenes(options, plan, run);
    nlohmann::ordered_json json = benchJson(run);
    size_t slower = 0;
    if (!options.compare.empty()) {
        const std::vector<RowComparison> comparison = compareRun(options.compare, old, run);
        slower = countChanged(comparison, Change::slower);
        json["compare"] = comparisonJson(options.compare, comparison);
        if (print) printComparison(options.compare, comparison);
    }
    if (!options.csv.empty()) writeCsv(options.csv, run);
    if (!options.json.empty()) writeJson(options.json, json);
    return slower > 0 ? ExitCode::checkFailed : ExitCode::done;
}

ExitCode bench(const BenchOptions& options) {
    if (options.scenes.empty() != options.scaling)
        throw Error(options.scaling ? "--scaling makes its own scenes; name none" : "name a scene to measure");
    requireFiles(options);
    if (options.scaling) return benchScaling(options);
    if (options.costs) return benchCosts(options);
    return options.tune ? benchTune(options) : benchScenes(options);
}

}  // namespace

void addBenchCommand(CLI::App& app, Command& chosen) {
    CLI::App* command =
        app.add_subcommand("bench", "rays a second by kind of ray, beside Embree and a walk on the CPU");
    const auto options = std::make_shared<BenchOptions>(*command);
    std::vector<std::string> kinds;
    for (const RayKind& kind : kRayKinds) kinds.emplace_back(kind.name);
    command->add_option("scenes", options->scenes, "glTF, GLB, OBJ, PLY or STL; or names of raylab's own scenes");
    CLI::Option* const compare =
        command
            ->add_option("--compare", options->compare,
                         "what --json wrote before: the ratios to it, and exit code 1 where something is slower")
            ->type_name("OLD.json");
    CLI::Option* const tune =
        command
            ->add_flag("--tune", options->tune,
                       "measure every layout and record the best for this device: what --layout auto is")
            ->excludes(compare);
    CLI::Option* const scaling =
        command
            ->add_flag("--scaling", options->scaling,
                       "measure caves of 1000 triangles and more, and fit the cost of a ray; --csv FILE also writes "
                       "FILE's name with .gnuplot, and .svg where gnuplot is installed")
            ->excludes(compare)
            ->excludes(tune);
    command
        ->add_flag(
            "--costs", options->costs,
            "fit what a node and a triangle cost: what --traversal-cost and --intersection-cost should be; every "
            "layout and triangle test, or what --vary names")
        ->excludes(compare)
        ->excludes(tune)
        ->excludes(scaling);
    command->add_option("--largest", options->largest, "triangles of the largest cave of --scaling")
        ->check(CLI::Range(10'000, 100'000'000))
        ->needs(scaling)
        ->capture_default_str();
    command->add_option("--vary", options->vary, "measure every value of a setting; repeated: every combination")
        ->type_name("NAME=A,B,C")
        ->allow_extra_args(false)
        ->excludes(tune)
        ->excludes(scaling);
    command->add_option("--rays", options->kinds, "kinds of rays; without: all")
        ->delimiter(',')
        ->check(CLI::IsMember(kinds))
        ->excludes(tune)
        ->excludes(scaling);
    command
        ->add_option("--light", options->light, "that shadow rays aim at; without: a rectangle below the scene's top")
        ->type_name("x,y,z,width,depth");
    command->add_option("--repeats", options->repeats, "timed runs of each, after one that is not counted")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    command->add_flag("--no-peers", options->noPeers, "leave out Embree and the walk on the CPU");
    command->add_flag("--materials", options->materials, "keep materials, so that alpha is tested; no peer does that");
    command->add_option("--csv", options->csv, "write the rows as a table")->type_name("FILE");
    command->add_option("--json", options->json, "write everything to a file, or - for standard output")
        ->type_name("FILE");
    command->callback([&chosen, options] { chosen = [options] { return bench(*options); }; });
}

}  // namespace raylab
