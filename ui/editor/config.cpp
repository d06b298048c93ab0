#include "ui/editor/config.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <span>

#include "engine/core/file.h"
#include "engine/core/log.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "raylab.editor/1";
constexpr size_t kMostRecent = 10;

/// Empty where the environment names no place.
fs::path configFile() {
    const char* const configHome = std::getenv("XDG_CONFIG_HOME");
    if (configHome != nullptr && fs::path(configHome).is_absolute())
        return fs::path(configHome) / "raylab" / "editor.json";
    const char* const home = std::getenv("HOME");
    return home != nullptr && *home != '\0' ? fs::path(home) / ".config" / "raylab" / "editor.json" : fs::path();
}

EditorConfig readConfig(const fs::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    const nlohmann::json json = nlohmann::json::parse(text, text + bytes.size());
    EditorConfig config;
    config.windowWidth = std::clamp(json.value("windowWidth", config.windowWidth), 320, 16384);
    config.windowHeight = std::clamp(json.value("windowHeight", config.windowHeight), 240, 16384);
    config.leftWidth = json.value("leftWidth", config.leftWidth);
    config.rightWidth = json.value("rightWidth", config.rightWidth);
    config.bottomHeight = json.value("bottomHeight", config.bottomHeight);
    config.showGrid = json.value("showGrid", config.showGrid);
    config.autosaveSeconds = std::clamp(json.value("autosaveSeconds", config.autosaveSeconds), 1, 86400);
    config.recent = json.value("recent", config.recent);
    config.tabs = json.value("tabs", config.tabs);
    return config;
}

}  // namespace

void EditorConfig::addRecent(const fs::path& path) {
    const std::string text = fs::absolute(path).lexically_normal().string();
    std::erase(recent, text);
    recent.insert(recent.begin(), text);
    if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

EditorConfig loadConfig() {
    const fs::path path = configFile();
    std::error_code missing;
    if (path.empty() || !fs::exists(path, missing)) return {};
    try {
        return readConfig(path);
    } catch (const std::exception& error) {
        logWarning(path.string() + " is ignored (" + error.what() + ")");
        return {};
    }
}

void saveConfig(const EditorConfig& config) {
    const fs::path path = configFile();
    if (path.empty()) return;
    const nlohmann::ordered_json json{{"schema", kSchema},
                                      {"windowWidth", config.windowWidth},
                                      {"windowHeight", config.windowHeight},
                                      {"leftWidth", config.leftWidth},
                                      {"rightWidth", config.rightWidth},
                                      {"bottomHeight", config.bottomHeight},
                                      {"showGrid", config.showGrid},
                                      {"autosaveSeconds", config.autosaveSeconds},
                                      {"recent", config.recent},
                                      {"tabs", config.tabs}};
    try {
        const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
        writeFileAtomically(path, std::as_bytes(std::span(text)));
    } catch (const std::exception& error) {
        logWarning(path.string() + " is not kept (" + error.what() + ")");
    }
}

}  // namespace raylab
