#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "engine/measure/stability/battery.h"

namespace raylab {

/// ../shared/scenes of a source tree that the program was built in; empty where there is none.
std::filesystem::path sharedScenes();

/// The cases of these ids (none: all) under the configurations of these sets, each once. Throws Error for an id or a
/// set that there is none of.
stability::Plan stabilityPlan(std::span<const std::string> ids, std::span<const std::string> sets,
                              const DeviceDescription& device);

}  // namespace raylab
