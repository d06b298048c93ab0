#include "ui/editor/model/project_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "ui/editor/model/edit_cameras.h"

namespace raylab::editor {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kSchema = "raylab.project/1";

bool isOfMachine(std::string_view name) { return name == "device" || name == "validation"; }

json changedSettings(const RenderSettings& settings) {
    json changed = json::object();
    const RenderSettings defaults;
    for (const Setting<RenderSettings>& setting : renderSettingsTable()) {
        const SettingValue value = getSetting(setting, settings);
        if (!isOfMachine(setting.name) && value != getSetting(setting, defaults))
            changed[std::string(setting.name)] = settingText(value);
    }
    return changed;
}

void readSettings(const json& source, Project& project) {
    for (const auto& [name, text] : source.items()) try {
            setSetting(findSetting(renderSettingsTable(), name), project.settings, text.get<std::string>());
        } catch (const Error& problem) {
            project.warnings.push_back("a setting was left out: " + std::string(problem.what()));
        }
}

void readHidden(const json& source, size_t instanceCount, Project& project) {
    if (source.value("instances", size_t{0}) != instanceCount) {
        project.warnings.emplace_back("the scene has other instances than when it was saved; all are shown");
        return;
    }
    project.hidden.assign(instanceCount, 0);
    for (const json& index : source.at("hidden"))
        if (const auto i = index.get<size_t>(); i < instanceCount) project.hidden[i] = 1;
}

Project parseProject(const json& source, size_t instanceCount) {
    if (source.at("schema") != kSchema) throw Error("");
    Project project;
    readSettings(source.at("settings"), project);
    if (source.contains("view")) project.view = parseCamera(source["view"].dump());
    if (source.contains("hidden")) readHidden(source, instanceCount, project);
    return project;
}

}  // namespace

fs::path projectFile(const fs::path& sceneFile) {
    return sceneFile.parent_path() / (sceneFile.stem().string() + ".raylab.json");
}

void writeProject(const fs::path& file, const Project& project) {
    json text = {{"schema", kSchema}, {"settings", changedSettings(project.settings)}};
    if (project.view) text["view"] = json::parse(cameraText(*project.view));
    if (std::count(project.hidden.begin(), project.hidden.end(), uint8_t{1}) > 0) {
        text["instances"] = project.hidden.size();
        for (size_t i = 0; i < project.hidden.size(); ++i)
            if (project.hidden[i] != 0) text["hidden"].push_back(i);
    }
    const std::string bytes = text.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
    writeFileAtomically(file, std::as_bytes(std::span(bytes)));
}

Project readProject(const fs::path& file, size_t instanceCount) {
    if (!fs::exists(file)) return {};
    const std::vector<std::byte> bytes = readFile(file);
    try {
        const auto* text = reinterpret_cast<const char*>(bytes.data());
        return parseProject(json::parse(text, text + bytes.size()), instanceCount);
    } catch (const std::exception&) {
        throw Error(file.string() +
                    ": is damaged, or not written by raylab; move it away to open the scene without it");
    }
}

}  // namespace raylab::editor
