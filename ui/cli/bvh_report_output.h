#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/measure/bvh_report.h"

namespace raylab {

/// The member "bvh" of `raylab info --json`. Figures that were not measured are null.
nlohmann::ordered_json bvhReportJson(const BvhReport& report);

/// One line of `raylab info`.
std::string bvhReportLine(const BvhReport& report);

/// What `raylab info --bvh` adds, with histograms.
std::string bvhReportText(const BvhReport& report);

}  // namespace raylab
