#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/render/render_settings.h"

namespace raylab {

/// Settings that differ from a base by assignments of a grid.
struct Variation {
    RenderSettings settings;
    std::vector<std::pair<std::string, std::string>> assigned;  ///< name and value, in order

    /// "name=value name=value"
    std::string text() const;
};

/// Every combination that the axes, each NAME=A,B,C, span over the base; the base alone without any. Throws Error for
/// what is no setting, or no value of one.
std::vector<Variation> gridOf(const RenderSettings& base, const std::vector<std::string>& axes);

/// The parts of a text between the separators.
std::vector<std::string> splitAt(const std::string& text, char separator);

}  // namespace raylab
