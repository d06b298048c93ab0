#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "engine/core/file.h"
#include "ui/cli/bench_output.h"

namespace raylab {
namespace {

constexpr std::array kChangeNames = {"", "faster", "SLOWER"};

RecordedRow rowFromJson(const nlohmann::json& json) {
    const auto text = [&](const char* key) { return json.at(key).get<std::string>(); };
    const auto rate = [&](const char* key) {
        const double value = json.at(key).get<double>();
        if (!(value > 0.0) || !std::isfinite(value)) throw Error(std::string(key) + " is not a rate");
        return value;
    };
    return {.scene = text("scene"),
            .rayKind = text("rayKind"),
            .tracer = text("tracer"),
            .layout = text("layout"),
            .triangle = text("triangle"),
            .builder = text("builder"),
            .variation = json.value("variation", ""),
            .mraysPerSecond = rate("mraysPerSecond"),
            .low = rate("low"),
            .high = rate("high")};
}

SubjectLabel labelOf(const RecordedRow& row) {
    return {row.tracer, row.layout, row.triangle, row.builder, row.variation};
}

nlohmann::ordered_json ratioJson(const Ratio& ratio) {
    return {{"value", ratio.value}, {"low", ratio.low}, {"high", ratio.high}};
}

void printRatio(const Ratio& ratio) {
    std::cout << std::fixed << std::setprecision(3) << std::setw(7) << ratio.value << " [" << std::setw(6) << ratio.low
              << ", " << std::setw(6) << ratio.high << "]";
}

}  // namespace

std::vector<RecordedRow> readBenchJson(const std::string& path) {
    const std::vector<std::byte> bytes = readFile(path);
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    try {
        const nlohmann::json json = nlohmann::json::parse(text, text + bytes.size());
        if (json.at("schema") != "raylab.bench/1") throw Error("its schema is not raylab.bench/1");
        std::vector<RecordedRow> rows;
        for (const nlohmann::json& row : json.at("rows")) rows.push_back(rowFromJson(row));
        return rows;
    } catch (const std::exception& error) {
        throw Error(path + ": is not what raylab bench --json writes (" + error.what() + ")");
    }
}

std::vector<RecordedRow> recordedRows(const std::vector<SceneRows>& scenes) {
    std::vector<RecordedRow> rows;
    for (const SceneRows& scene : scenes)
        for (const BenchRow& row : scene.rows)
            rows.push_back({scene.scene, row.rayKind, row.label.tracer, row.label.layout, row.label.triangle,
                            row.label.builder, row.label.variation, row.mraysPerSecond, row.low, row.high});
    return rows;
}

std::vector<RowComparison> compareRun(const std::string& oldPath, const std::vector<RecordedRow>& old,
                                      const BenchRun& run) {
    std::vector<RowComparison> comparisons = compareRows(old, recordedRows(run.scenes));
    if (comparisons.empty())
        throw Error(oldPath +
                    ": has none of the rows of this run; measure the same scenes, kinds of rays and settings");
    return comparisons;
}

void printComparison(const std::string& oldPath, const std::vector<RowComparison>& rows) {
    const bool normalised =
        std::ranges::any_of(rows, [](const RowComparison& row) { return row.normalised.has_value(); });
    std::cout << "\nnew over old (" << oldPath << "), with the interval that both runs' intervals allow\n"
              << (normalised
                      ? "second: normalised by embree1 on the same rays, for machines drift between runs; a row is "
                        "slower or faster where both intervals say so\n"
                      : "not normalised: embree1 is not in both runs, so a change of the machine's speed counts "
                        "as ours\n");
    for (const RowComparison& row : rows) {
        std::cout << "  ";
        printRatio(row.ratio);
        std::cout << "  ";
        if (row.normalised) printRatio(*row.normalised);
        std::cout << "  " << std::left << std::setw(7) << kChangeNames[static_cast<size_t>(row.change)] << std::right
                  << row.row.scene << " " << row.row.rayKind << " " << subjectText(labelOf(row.row)) << "\n";
    }
    std::cout << countChanged(rows, Change::slower) << " slower, " << countChanged(rows, Change::faster)
              << " faster of " << rows.size() << " rows\n";
}

nlohmann::ordered_json comparisonJson(const std::string& oldPath, const std::vector<RowComparison>& rows) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const RowComparison& row : rows)
        list.push_back({{"scene", row.row.scene},
                        {"rayKind", row.row.rayKind},
                        {"tracer", row.row.tracer},
                        {"layout", row.row.layout},
                        {"triangle", row.row.triangle},
                        {"builder", row.row.builder},
                        {"variation", row.row.variation},
                        {"ratio", ratioJson(row.ratio)},
                        {"normalised", row.normalised ? ratioJson(*row.normalised) : nlohmann::ordered_json(nullptr)},
                        {"slower", row.change == Change::slower},
                        {"faster", row.change == Change::faster}});
    return {{"old", oldPath},
            {"slower", countChanged(rows, Change::slower)},
            {"faster", countChanged(rows, Change::faster)},
            {"rows", list}};
}

size_t countChanged(const std::vector<RowComparison>& rows, Change change) {
    return static_cast<size_t>(std::ranges::count(rows, change, &RowComparison::change));
}

}  // namespace raylab
