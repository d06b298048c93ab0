#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/measure/bench_compare.h"
#include "engine/measure/memory_bench.h"
#include "ui/cli/bench_run.h"

namespace raylab {

/// What a run of `raylab bench` reports.
struct BenchRun {
    Device& device;
    RenderSettings settings;  ///< resolved; with several scenes, layout `auto` stays, as each row says its scene's
    int repeats = 5;
    MemoryBandwidth memory;
    std::vector<SceneRows> scenes;
    bool isComplete = true;  ///< Ctrl-C and the driver may end it before

    /// Whether the memory that was measured is what rays on the device read.
    bool memoryIsDevices() const { return device.description().kind == "cpu"; }
};

/// Calls `measure`, which adds to run.scenes by measureScene(). Where the device is lost or after Ctrl-C it writes the
/// rows that there are as --csv and --json ask, and throws DeviceLost or Error (exit code 130), saying so.
void measureKeepingRows(const BenchOptions& options, BenchRun& run, const std::function<void()>& measure);
/// The plan on one scene; the rows are printed where `print`. Ctrl-C ends it, and what measureKeepingRows() called.
void measureScene(BenchRun& run, const std::string& name, const Scene& scene, const BenchPlan& plan, bool print);
/// The plan on each of the scenes that the options name; the rows are printed as they come.
void measureScenes(const BenchOptions& options, const BenchPlan& plan, BenchRun& run);

std::string subjectText(const SubjectLabel& label);
void printMemory(const BenchRun& run);
void printRows(const BenchRun& run, const SceneRows& scene);

/// schema raylab.bench/1.
nlohmann::ordered_json benchJson(const BenchRun& run);
/// A last line says where the run is not complete.
void writeCsv(const std::string& path, const BenchRun& run);

/// The rows of a file that --json wrote. Throws Error, naming the file, for anything else.
std::vector<RecordedRow> readBenchJson(const std::string& path);
std::vector<RecordedRow> recordedRows(const std::vector<SceneRows>& scenes);

/// Throws Error where the old file has none of the new rows.
std::vector<RowComparison> compareRun(const std::string& oldPath, const std::vector<RecordedRow>& old,
                                      const BenchRun& run);
void printComparison(const std::string& oldPath, const std::vector<RowComparison>& rows);
nlohmann::ordered_json comparisonJson(const std::string& oldPath, const std::vector<RowComparison>& rows);
size_t countChanged(const std::vector<RowComparison>& rows, Change change);

}  // namespace raylab
