#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/image/image_io.h"
#include "engine/render/render_settings.h"
#include "ui/report/settings_file.h"

namespace raylab {

/// Texts of settings as the user wrote them, in order; resolved after parsing.
class SettingOptions {
public:
    /// Adds an option for every row of the render settings table, --set NAME=VALUE, and --preset FILE.
    explicit SettingOptions(CLI::App& command);
    /// The defaults, what the preset says, and over both what the user wrote. Throws Error for a value that its
    /// setting does not take.
    RenderSettings resolve() const;

private:
    std::vector<std::pair<std::string, std::string>> named_;
    std::vector<std::string> sets_;
    std::string preset_;
};

/// The file of a scene: a path, or the name of a scene that comes with raylab ("courtyard"). Throws Error.
std::filesystem::path scenePath(const std::string& text);

Metadata settingsMetadata(const RenderSettings& settings);

}  // namespace raylab
