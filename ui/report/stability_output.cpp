#include "ui/report/stability_output.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "engine/core/file.h"

namespace raylab {
namespace {

using Json = nlohmann::ordered_json;
using stability::Row;

std::string limitText(const Row& row) {
    return std::isfinite(row.number.limit) ? stabilityNumber(row.number.limit) : "-";
}

/// JSON knows no infinity and no NaN.
Json jsonNumber(double number) { return std::isfinite(number) ? Json(number) : Json(nullptr); }

Json rowJson(const Row& row) {
    Json json;
    json["id"] = row.id;
    json["provokes"] = row.provokes;
    json["config"] = row.config;
    json["isDefault"] = row.isDefault;
    const bool measured = row.skipped.empty();
    json["what"] = row.number.what;
    json["number"] = measured ? jsonNumber(row.number.value) : Json(nullptr);
    json["limit"] = measured ? jsonNumber(row.number.limit) : Json(nullptr);
    json["unit"] = row.number.unit;
    json["pass"] = measured ? Json(row.passes()) : Json(nullptr);
    if (!measured) json["skipped"] = row.skipped;
    if (!row.number.note.empty()) json["note"] = row.number.note;
    json["seconds"] = row.seconds;
    return json;
}

std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

size_t StabilityRun::defaultFailures() const {
    return static_cast<size_t>(
        std::ranges::count_if(result.rows, [](const Row& row) { return row.isDefault && row.fails(); }));
}

std::string stabilityNumber(double number) {
    std::ostringstream text;
    text << std::setprecision(4) << number;
    return text.str();
}

std::string stabilityVerdict(const Row& row) {
    if (!row.skipped.empty()) return "skipped";
    if (!std::isfinite(row.number.limit)) return "shown";
    return row.passes() ? "pass" : "FAIL";
}

std::string rowLine(const Row& row) {
    std::ostringstream line;
    line << std::left << std::setw(5) << row.id << std::setw(26) << row.config << std::setw(9) << stabilityVerdict(row);
    if (!row.skipped.empty()) {
        line << row.provokes << ": " << row.skipped;
        return line.str();
    }
    line << std::right << std::setw(11) << stabilityNumber(row.number.value) << std::setw(9) << limitText(row) << "  "
         << std::left << std::setw(16) << row.number.unit << " " << row.number.what;
    if (!row.number.note.empty()) line << " (" << row.number.note << ")";
    return line.str();
}

void printSummary(const StabilityRun& run) {
    size_t passed = 0, failed = 0, skipped = 0;
    for (const Row& row : run.result.rows) {
        passed += row.passes() ? 1u : 0u;
        failed += row.fails() ? 1u : 0u;
        skipped += row.skipped.empty() ? 0u : 1u;
    }
    std::cout << "\n"
              << passed << " pass, " << failed << " fail, " << skipped << " skipped, in " << std::setprecision(3)
              << run.seconds << " s on " << run.device.name << "\n";
    if (!run.result.complete) std::cout << "partial: stopped before the end\n";
    for (const Row& row : run.result.rows)
        if (row.isDefault && row.fails())
            std::cout << "FAILED by the default: " << row.id << ", " << row.number.what << ": "
                      << stabilityNumber(row.number.value) << ", limit " << limitText(row) << "\n";
}

Json stabilityJson(const StabilityRun& run) {
    Json json;
    json["schema"] = "raylab.stability/1";
    json["device"] = run.device.name;
    json["driver"] = run.device.driver;
    json["quick"] = run.quick;
    json["complete"] = run.result.complete;
    json["seconds"] = run.seconds;
    json["defaultFailures"] = run.defaultFailures();
    json["rows"] = Json::array();
    for (const Row& row : run.result.rows) json["rows"].push_back(rowJson(row));
    return json;
}

void writeStabilityCsv(const std::filesystem::path& path, const StabilityRun& run) {
    std::ostringstream csv;
    csv << std::setprecision(9) << "id,config,isDefault,what,number,limit,unit,verdict,seconds,note\n";
    for (const Row& row : run.result.rows) {
        const bool measured = row.skipped.empty();
        csv << row.id << "," << csvField(row.config) << "," << (row.isDefault ? 1 : 0) << ","
            << csvField(measured ? row.number.what : row.provokes) << ",";
        if (measured) csv << row.number.value;
        csv << ",";
        if (measured && std::isfinite(row.number.limit)) csv << row.number.limit;
        csv << "," << csvField(row.number.unit) << "," << stabilityVerdict(row) << "," << row.seconds << ","
            << csvField(measured ? row.number.note : row.skipped) << "\n";
    }
    const std::string text = csv.str();
    writeFileAtomically(path, std::as_bytes(std::span(text)));
}

}  // namespace raylab
