#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "engine/accel/layout.h"
#include "engine/render/device_defaults.h"
#include "ui/cli/bench_output.h"

namespace raylab {
namespace {

/// Only layouts under this test are recorded: what leaks is no default.
constexpr const char* kTightTest = "watertight";
constexpr std::array kTests = {kTightTest, "minimal"};

struct Ranked {
    std::string layout;
    std::string triangle;
    double mraysPerSecond = 0.0;  ///< geometric mean over scenes and kinds of rays
};

std::vector<Variant> candidates(const RenderSettings& base) {
    std::vector<Variant> variants;
    for (const std::string& layout : layoutNames())
        for (const char* triangle : kTests) {
            variants.push_back({base, ""});
            variants.back().settings.tracer = "software";
            variants.back().settings.layout = layout;
            variants.back().settings.triangle = triangle;
        }
    return variants;
}

double geometricMean(const std::vector<SceneRows>& scenes, const Ranked& of) {
    double logarithms = 0.0, count = 0.0;
    for (const SceneRows& scene : scenes)
        for (const BenchRow& row : scene.rows)
            if (row.label.layout == of.layout && row.label.triangle == of.triangle) {
                logarithms += std::log(row.mraysPerSecond);
                count += 1.0;
            }
    return count > 0.0 ? std::exp(logarithms / count) : 0.0;
}

std::vector<Ranked> rankingOf(const std::vector<SceneRows>& scenes) {
    std::vector<Ranked> ranking;
    for (const std::string& layout : layoutNames())
        for (const char* triangle : kTests) {
            ranking.push_back({layout, triangle});
            ranking.back().mraysPerSecond = geometricMean(scenes, ranking.back());
        }
    std::ranges::stable_sort(ranking, std::greater<>(), &Ranked::mraysPerSecond);
    return ranking;
}

nlohmann::ordered_json tuneJson(const std::vector<Ranked>& ranking, const std::string& recorded) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Ranked& entry : ranking)
        list.push_back(
            {{"layout", entry.layout}, {"triangle", entry.triangle}, {"mraysPerSecond", entry.mraysPerSecond}});
    return {{"ranking", list}, {"recorded", recorded}, {"file", deviceDefaultsFile().string()}};
}

}  // namespace

ExitCode benchTune(const BenchOptions& options) {
    const RenderSettings settings = options.settings.resolve();
    Device device({settings.device, settings.validation});
    BenchRun run{device, resolveForDevice(settings, device.description()), options.repeats, measureHostMemory(), {}};
    const BenchPlan plan{.base = run.settings,
                         .variants = candidates(run.settings),
                         .kinds = {"primary", "shadow", "diffuse"},
                         .light = options.light,
                         .repeats = options.repeats};
    measureScenes(options, plan, run);
    const std::vector<Ranked> ranking = rankingOf(run.scenes);
    const auto best = std::ranges::find(ranking, kTightTest, &Ranked::triangle);
    if (best == ranking.end() || !(best->mraysPerSecond > 0.0))
        throw Error("no ray could be traced, so no layout is best; choose a camera that sees the scene");
    recordLayout(device.description(), best->layout);
    if (!options.csv.empty()) writeCsv(options.csv, run);
    nlohmann::ordered_json json = benchJson(run);
    json["tune"] = tuneJson(ranking, best->layout);
    if (!options.json.empty()) writeJson(options.json, json);
    if (options.json == "-") return ExitCode::done;
    std::cout << "\ngeometric mean, Mrays/s\n" << std::fixed << std::setprecision(2);
    for (const Ranked& entry : ranking)
        std::cout << "  " << std::setw(7) << entry.mraysPerSecond << "  " << entry.layout << " " << entry.triangle
                  << "\n";
    std::cout << "--layout auto is " << best->layout << " on " << device.description().name << " from now on ("
              << deviceDefaultsFile().string() << ")\n";
    return ExitCode::done;
}

}  // namespace raylab
