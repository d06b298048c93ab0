#include "ui/cli/bench_output.h"

#include <iomanip>
#include <iostream>
#include <sstream>

#include "engine/core/file.h"
#include "engine/gpu/check.h"
#include "engine/render/device_defaults.h"
#include "ui/cli/interrupt.h"

namespace raylab {
namespace {

/// Bytes a second that a row's rays fetch; nothing where nobody counted.
std::optional<double> bytesPerSecond(const BenchRow& row) {
    if (!row.counters) return std::nullopt;
    return bytesPerRay(row.label, *row.counters) * row.mraysPerSecond * 1e6;
}

void printCounters(const BenchRun& run, const BenchRow& row) {
    const double bandwidth = *bytesPerSecond(row);
    std::cout << std::setprecision(1) << "  (" << row.counters->nodes << " nodes, " << row.counters->triangles
              << " triangles, " << row.counters->instances << " instances a ray, balance " << std::setprecision(2)
              << row.counters->balance << "; " << std::setprecision(0) << bytesPerRay(row.label, *row.counters)
              << " bytes a ray, " << std::setprecision(2) << bandwidth * 1e-9 << " GB/s";
    if (run.memoryIsDevices())
        std::cout << ", " << bandwidth / run.memory.gatherLarge << " x of gather from 64 MiB, "
                  << bandwidth / run.memory.gatherSmall << " x from 1 MiB";
    std::cout << ")";
}

nlohmann::ordered_json rowJson(const BenchRun& run, const std::string& scene, const BenchRow& row) {
    nlohmann::ordered_json json{{"scene", scene},
                                {"rayKind", row.rayKind},
                                {"tracer", row.label.tracer},
                                {"layout", row.label.layout},
                                {"triangle", row.label.triangle},
                                {"builder", row.label.builder},
                                {"variation", row.label.variation},
                                {"mraysPerSecond", row.mraysPerSecond},
                                {"low", row.low},
                                {"high", row.high},
                                {"rays", row.rays},
                                {"hits", row.hits}};
    if (!row.counters) return json;
    const double bandwidth = *bytesPerSecond(row);
    json["perRay"] = {{"nodes", row.counters->nodes},
                      {"triangles", row.counters->triangles},
                      {"instances", row.counters->instances},
                      {"balanceOf8", row.counters->balance},
                      {"bytes", bytesPerRay(row.label, *row.counters)}};
    json["bytesPerSecond"] = bandwidth;
    if (!run.memoryIsDevices()) return json;
    json["ofGather64MiB"] = bandwidth / run.memory.gatherLarge;
    json["ofGather1MiB"] = bandwidth / run.memory.gatherSmall;
    return json;
}

/// Ctrl-C, on its way from a scene to who keeps the rows.
struct Interrupted {};

/// Writes what there is, and says how much that is. `loss`: of the device, or empty.
std::string keepRows(const BenchOptions& options, BenchRun& run, const std::string& loss) {
    run.isComplete = false;
    if (!options.csv.empty()) writeCsv(options.csv, run);
    nlohmann::ordered_json json = benchJson(run);
    if (!loss.empty()) json["deviceLoss"] = loss;
    if (!options.json.empty()) writeJson(options.json, json);
    return "what was measured before is kept (rows: " + std::to_string(json["rows"].size()) + ")";
}

}  // namespace

void measureKeepingRows(const BenchOptions& options, BenchRun& run, const std::function<void()>& measure) {
    const InterruptGuard guard;
    try {
        measure();
    } catch (const Interrupted&) {
        throw Error("interrupted; " + keepRows(options, run, ""), kInterrupted);
    } catch (const DeviceLost& loss) {
        throw DeviceLost(std::string(loss.what()) + "; " + keepRows(options, run, loss.what()));
    }
}

void measureScene(BenchRun& run, const std::string& name, const Scene& scene, const BenchPlan& plan, bool print) {
    run.scenes.push_back(benchScene(run.device, name, scene, plan));
    if (print) printRows(run, run.scenes.back());
    if (!run.scenes.back().complete) throw Interrupted();
}

void measureScenes(const BenchOptions& options, const BenchPlan& plan, BenchRun& run) {
    measureKeepingRows(options, run, [&] {
        for (const std::string& name : options.scenes) {
            if (InterruptGuard::isInterrupted()) throw Interrupted();
            const Scene scene = loadBenchScene(name, options.materials);
            if (options.scenes.size() == 1)
                run.settings = resolveForDevice(run.settings, run.device.description(), scene);
            measureScene(run, name, scene, plan, options.json != "-");
        }
    });
}

std::string subjectText(const SubjectLabel& label) {
    std::string text = label.tracer;
    if (!label.layout.empty()) text += " " + label.layout + " " + label.triangle + " " + label.builder;
    return label.variation.empty() ? text : text + "  " + label.variation;
}

void printMemory(const BenchRun& run) {
    std::cout << std::fixed << std::setprecision(1) << "host memory, all threads: copy " << run.memory.copy * 1e-9
              << " GB/s, gather of 16 bytes " << run.memory.gatherLarge * 1e-9 << " GB/s from 64 MiB, "
              << run.memory.gatherSmall * 1e-9 << " GB/s from 1 MiB"
              << (run.memoryIsDevices() ? "" : "; the device has memory of its own, which is not measured") << "\n";
}

void printRows(const BenchRun& run, const SceneRows& scene) {
    std::cout << scene.scene << "\n";
    std::string kind;
    double first = 0.0;
    for (const BenchRow& row : scene.rows) {
        if (row.rayKind != kind) {
            std::cout << "  " << row.rayKind << ", " << row.rays << " rays, " << row.hits << " hits\n";
            first = row.mraysPerSecond;
        }
        kind = row.rayKind;
        std::cout << "    " << std::fixed << std::setprecision(2) << std::setw(7) << row.mraysPerSecond << " Mrays/s  ["
                  << std::setw(6) << row.low << ", " << std::setw(6) << row.high << "]  " << std::setw(5)
                  << first / row.mraysPerSecond << " x  " << subjectText(row.label);
        if (row.counters) printCounters(run, row);
        std::cout << "\n";
    }
    std::cout << std::flush;
}

nlohmann::ordered_json benchJson(const BenchRun& run) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const SceneRows& scene : run.scenes)
        for (const BenchRow& row : scene.rows) rows.push_back(rowJson(run, scene.scene, row));
    return {{"schema", "raylab.bench/1"},
            {"device", run.device.description().name},
            {"driver", run.device.description().driver},
            {"repeats", run.repeats},
            {"settings", settingsJson(run.settings)},
            {"memory",
             {{"place", "host"},
              {"isDevices", run.memoryIsDevices()},
              {"copyBytesPerSecond", run.memory.copy},
              {"gather64MiBBytesPerSecond", run.memory.gatherLarge},
              {"gather1MiBBytesPerSecond", run.memory.gatherSmall}}},
            {"complete", run.isComplete},
            {"rows", rows}};
}

void writeCsv(const std::string& path, const BenchRun& run) {
    std::ostringstream text;
    text << "scene,rayKind,tracer,layout,triangle,builder,variation,mraysPerSecond,low,high,rays,hits,bytesPerRay\n";
    for (const SceneRows& scene : run.scenes)
        for (const BenchRow& row : scene.rows) {
            text << scene.scene << ',' << row.rayKind << ',' << row.label.tracer << ',' << row.label.layout << ','
                 << row.label.triangle << ',' << row.label.builder << ',' << row.label.variation << ','
                 << row.mraysPerSecond << ',' << row.low << ',' << row.high << ',' << row.rays << ',' << row.hits
                 << ',';
            if (row.counters) text << bytesPerRay(row.label, *row.counters);
            text << '\n';
        }
    if (!run.isComplete) text << "# ended early: rows are missing\n";
    const std::string content = text.str();
    writeFileAtomically(path, std::as_bytes(std::span(content)));
}

}  // namespace raylab
