#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <iomanip>
#include <iostream>

#include "engine/accel/layout.h"
#include "engine/measure/cost_fit.h"
#include "engine/render/camera.h"
#include "engine/render/device_defaults.h"
#include "engine/render/triangle_record.h"
#include "ui/cli/bench_output.h"

namespace raylab {
namespace {

/// Trees of different quality: rays of one kind then visit few nodes and many.
constexpr std::array kTrees = {"binned", "median"};
constexpr int kViews = 4;

struct ConfigurationCosts {
    SubjectLabel label;  ///< without a builder
    CostFit fit;
};

/// The chosen camera, turned about its upward direction by quarters.
std::vector<Camera> viewsOf(const Scene& scene, const RenderSettings& settings) {
    std::vector<Camera> views;
    for (int i = 0; i < kViews; ++i) {
        Camera camera = chooseCamera(scene, settings.camera);
        const float angle = glm::radians(360.0f * static_cast<float>(i) / static_cast<float>(kViews));
        const glm::mat3 turn(glm::rotate(glm::mat4(1.0f), angle, camera.up));
        camera.target = camera.position + turn * (camera.target - camera.position);
        views.push_back(camera);
    }
    return views;
}

std::string joined(const std::string& name, const std::vector<std::string>& values) {
    std::string text = name;
    for (const std::string& value : values) text += (text == name ? "=" : ",") + value;
    return text;
}

/// What --vary spans, or every layout with every triangle test; on the software tracer, which alone counts.
std::vector<Variant> configurationsOf(const BenchOptions& options, RenderSettings base) {
    base.tracer = "software";
    if (!options.vary.empty()) return variantsOf(base, options.vary);
    return variantsOf(base, {joined("layout", layoutNames()), joined("triangle", triangleTestNames())});
}

/// What idle lanes wait for counts as work: they cannot do any other.
void addSamples(const SceneRows& rows, std::vector<CostSample>& samples) {
    for (const BenchRow& row : rows.rows)
        if (row.counters && row.counters->balance > 0.0)
            samples.push_back({1e3 / row.mraysPerSecond, row.counters->nodes / row.counters->balance,
                               row.counters->triangles / row.counters->balance});
}

/// One configuration at a time: the trees of all would not fit.
ConfigurationCosts measureCosts(BenchRun& run, const BenchOptions& options, const Variant& configuration) {
    BenchPlan plan{.base = run.settings,
                   .variants = {},
                   .kinds = options.kinds,
                   .light = options.light,
                   .repeats = options.repeats};
    for (const char* tree : kTrees) {
        plan.variants.push_back(configuration);
        plan.variants.back().settings.builder = tree;
    }
    std::vector<CostSample> samples;
    for (const std::string& name : options.scenes) {
        Scene scene = loadBenchScene(name, options.materials);
        for (const Camera& view : viewsOf(scene, run.settings)) {
            scene.cameras.push_back(view);
            plan.base.camera = std::to_string(scene.cameras.size() - 1);
            measureScene(run, name, scene, plan, false);
            addSamples(run.scenes.back(), samples);
        }
    }
    const RenderSettings& settings = configuration.settings;
    return {{settings.tracer, resolveForDevice(settings, run.device.description()).layout, settings.triangle, "",
             configuration.text},
            fitCosts(samples)};
}

nlohmann::ordered_json estimateJson(const Estimate& estimate) {
    return {{"value", estimate.value}, {"standardError", estimate.standardError}};
}

nlohmann::ordered_json costsJson(const std::vector<ConfigurationCosts>& all) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const ConfigurationCosts& costs : all)
        list.push_back({{"layout", costs.label.layout},
                        {"triangle", costs.label.triangle},
                        {"variation", costs.label.variation},
                        {"nsPerRay", estimateJson(costs.fit.constant)},
                        {"nsPerNode", estimateJson(costs.fit.node)},
                        {"nsPerTriangle", estimateJson(costs.fit.triangle)},
                        {"intersectionCost", estimateJson(costs.fit.ratio)},
                        {"relativeResidual", costs.fit.relativeResidual},
                        {"samples", costs.fit.samples}});
    return list;
}

std::ostream& operator<<(std::ostream& out, const Estimate& estimate) {
    return out << std::setw(8) << estimate.value << " +- " << std::setw(7) << std::left << estimate.standardError
               << std::right;
}

void printCosts(const ConfigurationCosts& costs) {
    std::cout << std::fixed << std::setprecision(2) << std::setw(28) << std::left << subjectText(costs.label)
              << std::right << "ns a ray " << costs.fit.constant << " a node " << costs.fit.node << " a triangle "
              << costs.fit.triangle << " triangle / node " << costs.fit.ratio << " (" << std::setprecision(1)
              << 100.0 * costs.fit.relativeResidual << " % left over, " << costs.fit.samples << " samples)\n";
}

}  // namespace

ExitCode benchCosts(const BenchOptions& options) {
    const RenderSettings settings = options.settings.resolve();
    Device device({settings.device, settings.validation});
    BenchRun run{device, resolveForDevice(settings, device.description()), options.repeats, measureHostMemory(), {}};
    std::vector<ConfigurationCosts> all;
    measureKeepingRows(options, run, [&] {
        for (const Variant& configuration : configurationsOf(options, run.settings)) {
            all.push_back(measureCosts(run, options, configuration));
            if (options.json != "-") printCosts(all.back());
        }
    });
    if (!options.csv.empty()) writeCsv(options.csv, run);
    nlohmann::ordered_json json = benchJson(run);
    json["costs"] = costsJson(all);
    if (!options.json.empty()) writeJson(options.json, json);
    return ExitCode::done;
}

}  // namespace raylab
