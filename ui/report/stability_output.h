#pragma once

#include <filesystem>
#include <string>

#include "engine/measure/stability/battery.h"
#include "ui/report/settings_file.h"

namespace raylab {

/// What `raylab stability` measured, for all reports.
struct StabilityRun {
    DeviceDescription device;
    bool quick = false;
    double seconds = 0.0;
    stability::BatteryResult result;

    /// Rows of the default configuration that fail.
    size_t defaultFailures() const;
};

/// Of four digits.
std::string stabilityNumber(double number);
/// "pass", "FAIL", "shown" where there is no limit, or "skipped".
std::string stabilityVerdict(const stability::Row& row);
/// A line for a row, as the table on the terminal has it.
std::string rowLine(const stability::Row& row);
/// How many passed, failed and were skipped, and what the default fails.
void printSummary(const StabilityRun& run);
/// schema raylab.stability/1.
nlohmann::ordered_json stabilityJson(const StabilityRun& run);
/// A header and a line a row.
void writeStabilityCsv(const std::filesystem::path& path, const StabilityRun& run);
/// FOLDER/stability.html, which needs no other file, and its pictures as PNGs beside it.
void writeStabilityHtml(const std::filesystem::path& folder, const StabilityRun& run);

}  // namespace raylab
