#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace raylab {

/// What the editor remembers from one time to the next, in $XDG_CONFIG_HOME/raylab/editor.json or
/// ~/.config/raylab/editor.json. Sizes are in the desktop's units.
struct EditorConfig {
    int windowWidth = 1280;
    int windowHeight = 720;
    float leftWidth = 230.0f;
    float rightWidth = 300.0f;
    float bottomHeight = 150.0f;
    bool showGrid = false;
    int autosaveSeconds = 60;                 ///< between copies of unsaved edits
    std::vector<std::string> recent;          ///< files, the latest first
    std::map<std::string, std::string> tabs;  ///< the panel in front, by pane

    void addRecent(const std::filesystem::path& path);
};

/// Defaults where there is no file; a damaged one is warned of and ignored.
EditorConfig loadConfig();

/// A failure is warned of: nothing of the user's work is lost by it.
void saveConfig(const EditorConfig& config);

}  // namespace raylab
