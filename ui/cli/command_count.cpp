#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "engine/core/file.h"
#include "engine/measure/image_pair.h"
#include "engine/measure/path_counts.h"
#include "engine/measure/tree_export.h"
#include "engine/render/camera.h"
#include "engine/render/device_defaults.h"
#include "ui/cli/bench_run.h"
#include "ui/cli/commands.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHistogramFile = "histograms.csv";

struct CountOptions {
    explicit CountOptions(CLI::App& command) : settings(command) {}

    SettingOptions settings;
    std::string scene;
    std::string folder;
    std::string json;
    std::vector<int64_t> walk;  ///< a pixel; empty: none
    int bounces = 2;
    bool materials = false;
};

/// What is common to all files of a run.
struct CountRun {
    const CountOptions& options;
    RenderSettings settings;
    std::vector<BounceCounts> bounces;
    std::string traversal;
};

/// A picture of each counter of each bounce, and all counters of a bounce in one EXR.
void writeMaps(const CountRun& run) {
    const auto width = static_cast<uint32_t>(run.settings.width), height = static_cast<uint32_t>(run.settings.height);
    for (size_t bounce = 0; bounce < run.bounces.size(); ++bounce) {
        const fs::path stem = fs::path(run.options.folder) / ("bounce" + std::to_string(bounce));
        std::vector<Layer> layers;
        for (const CountField& field : kCountFields) {
            const Bitmap map = countMap(run.bounces[bounce], field, width, height);
            const double most = std::max(summarise(run.bounces[bounce], field).most, 1u);
            writePng(stem.string() + "-" + std::string(field.name) + ".png", heatPicture(map, 0.0, most));
            layers.push_back({std::string(field.name), map});
        }
        writeExr(stem.string() + ".exr", layers, settingsMetadata(run.settings));
    }
}

void writeHistograms(const CountRun& run) {
    std::ostringstream text;
    text << "bounce,counter,from,to,rays\n";
    for (size_t bounce = 0; bounce < run.bounces.size(); ++bounce)
        for (const CountField& field : kCountFields) {
            const std::vector<uint64_t> histogram = summarise(run.bounces[bounce], field).histogram;
            for (size_t bin = 0; bin < histogram.size(); ++bin) {
                const uint64_t from = bin == 0 ? 0 : uint64_t{1} << (bin - 1);
                const uint64_t to = bin == 0 ? 0 : (uint64_t{1} << bin) - 1;
                text << bounce << ',' << field.name << ',' << from << ',' << to << ',' << histogram[bin] << '\n';
            }
        }
    const std::string csv = text.str();
    writeFileAtomically(fs::path(run.options.folder) / "histograms.csv", std::as_bytes(std::span(csv)));
}

nlohmann::ordered_json countJson(const CountRun& run) {
    nlohmann::ordered_json json{{"schema", "raylab.count/1"},
                                {"scene", run.options.scene},
                                {"settings", settingsJson(run.settings)},
                                {"bounces", nlohmann::ordered_json::array()}};
    for (const BounceCounts& bounce : run.bounces) {
        nlohmann::ordered_json entry{{"rays", bounce.counts.size()}};
        for (const CountField& field : kCountFields) {
            const CountSummary summary = summarise(bounce, field);
            entry[std::string(field.name)] = {{"mean", summary.mean},
                                              {"median", summary.median},
                                              {"percentile99", summary.high},
                                              {"most", summary.most},
                                              {"histogram", summary.histogram}};
        }
        json["bounces"].push_back(entry);
    }
    return json;
}

void printCounts(const CountRun& run) {
    std::cout << run.options.scene << ", " << run.traversal << "\n";
    for (size_t bounce = 0; bounce < run.bounces.size(); ++bounce) {
        std::cout << (bounce == 0 ? "primary rays" : "bounce " + std::to_string(bounce)) << ", "
                  << run.bounces[bounce].counts.size() << " rays\n";
        for (const CountField& field : kCountFields) {
            const CountSummary summary = summarise(run.bounces[bounce], field);
            std::cout << "  " << std::left << std::setw(17) << field.name << std::right << " mean " << std::setw(8)
                      << std::fixed << std::setprecision(2) << summary.mean << "  median " << std::setw(5)
                      << summary.median << "  99 % " << std::setw(5) << summary.high << "  most " << std::setw(5)
                      << summary.most << "  (" << field.help << ")\n";
        }
    }
}

/// Through the centre of a pixel.
WalkRay rayThrough(const BenchView& view, const std::vector<int64_t>& pixel) {
    if (pixel[0] < 0 || pixel[0] >= view.width || pixel[1] < 0 || pixel[1] >= view.height)
        throw Error("--walk: " + std::to_string(pixel[0]) + "," + std::to_string(pixel[1]) +
                    " is not in the picture of " + std::to_string(view.width) + " x " + std::to_string(view.height) +
                    " pixels");
    shared::FrameParams frame{};
    writeCamera(view.camera, view.width, view.height, frame);
    const double x = (2.0 * static_cast<double>(pixel[0]) + 1.0) / view.width - 1.0;
    const double y = 1.0 - (2.0 * static_cast<double>(pixel[1]) + 1.0) / view.height;
    const glm::vec3 direction =
        frame.cameraForward + static_cast<float>(x) * frame.cameraRight + static_cast<float>(y) * frame.cameraUp;
    return {view.camera.position, glm::normalize(direction)};
}

nlohmann::ordered_json withWalk(nlohmann::ordered_json json, const CountRun& run, const Scene& scene,
                                const BenchView& view) {
    if (run.options.walk.empty()) return json;
    const TreeInspection trees = inspectTrees(scene, traceConfig(run.settings, scene));
    json["walk"] = nlohmann::ordered_json::parse(walkJson(trees, walkRay(trees, rayThrough(view, run.options.walk))));
    return json;
}

ExitCode count(const CountOptions& options) {
    if (!options.walk.empty() && options.json.empty()) throw Error("--walk writes into --json; give it a FILE, or -");
    CountRun run{options, options.settings.resolve(), {}, {}};
    if (!options.folder.empty()) requireWritable(fs::path(options.folder) / kHistogramFile);
    const Scene scene = loadBenchScene(options.scene, options.materials);
    Device device({run.settings.device, run.settings.validation});
    run.settings = resolveForDevice(run.settings, device.description(), scene);
    RayCaster caster(device, scene, run.settings);
    BenchView view;
    view.camera = chooseCamera(scene, run.settings.camera);
    view.width = static_cast<uint32_t>(run.settings.width);
    view.height = static_cast<uint32_t>(run.settings.height);
    view.seed = static_cast<uint32_t>(run.settings.seed);
    run.bounces = countPaths(caster, scene, view, options.bounces);
    run.traversal = "tracer " + std::string(caster.prepared().tracer->info().name);
    if (!caster.prepared().tracer->info().driverStructures) run.traversal += ", layout " + run.settings.layout;
    if (!options.folder.empty()) {
        writeMaps(run);
        writeHistograms(run);
    }
    if (!options.json.empty()) writeJson(options.json, withWalk(countJson(run), run, scene, view));
    if (options.json != "-") printCounts(run);
    return device.validationMessageCount() == 0 ? ExitCode::done : ExitCode::internalError;
}

}  // namespace

void addCountCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("count", "count what the traversal does for each ray, bounce by bounce");
    const auto options = std::make_shared<CountOptions>(*command);
    command->add_option("scene", options->scene, "file, or the name of a scene that comes with raylab")->required();
    command
        ->add_option("-o,--output", options->folder,
                     "folder for a picture a counter and bounce, EXR and histograms.csv")
        ->type_name("DIR");
    command->add_option("--bounces", options->bounces, "diffuse bounces after the primary rays")
        ->check(CLI::Range(0, 64));
    command
        ->add_option("--walk", options->walk,
                     "a pixel: the walk of the ray through its centre goes into --json, node by node")
        ->type_name("X,Y")
        ->delimiter(',')
        ->expected(2);
    command->add_flag("--materials", options->materials, "keep the materials, whose alpha tests count too");
    command->add_option("--json", options->json, "write the figures to a file, or - for standard output")
        ->type_name("FILE");
    command->callback([&chosen, options] { chosen = [options] { return count(*options); }; });
}

}  // namespace raylab
