#include "ui/report/settings_file.h"

#include <iostream>
#include <span>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/file.h"

namespace raylab {
namespace {

std::string textOf(const nlohmann::json& value, const std::string& name) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
    if (value.is_number_integer()) return std::to_string(value.get<int64_t>());
    if (value.is_number()) return settingText(value.get<double>());
    throw Error("'" + name + "' must be a text, a number, true or false");
}

}  // namespace

nlohmann::ordered_json settingsJson(const RenderSettings& settings) {
    nlohmann::ordered_json json;
    for (const Setting<RenderSettings>& setting : renderSettingsTable())
        std::visit([&](const auto& value) { json[std::string(setting.name)] = value; }, getSetting(setting, settings));
    return json;
}

void writeJson(const std::string& path, const nlohmann::ordered_json& json) {
    const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    if (path == "-") {
        std::cout << text << std::flush;
        if (!std::cout) throw Error("standard output cannot be written");
        return;
    }
    writeFileAtomically(path, std::as_bytes(std::span(text)));
}

nlohmann::json readJsonFile(const std::string& path) {
    const std::vector<std::byte> bytes = readFile(path);
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    try {
        return nlohmann::json::parse(text, text + bytes.size());
    } catch (const nlohmann::json::parse_error& error) {
        throw Error(path + ": is no JSON (" + error.what() + ")");
    }
}

void applySettings(RenderSettings& settings, const nlohmann::json& object, const std::string& file) {
    if (!object.is_object()) throw Error(file + ": settings are an object, such as {\"depth\": 4}");
    for (const auto& [name, value] : object.items()) try {
            setSetting(findSetting(renderSettingsTable(), name), settings, textOf(value, name));
        } catch (const Error& error) {
            throw Error(file + ": " + error.what());
        }
}

void applyPreset(RenderSettings& settings, const std::string& file) {
    const nlohmann::json json = readJsonFile(file);
    const bool isDocument = json.is_object() && json.contains("settings");
    applySettings(settings, isDocument ? json["settings"] : json, file);
}

std::string settingsAsOptions(const RenderSettings& settings) {
    std::string text;
    for (const Setting<RenderSettings>& setting : renderSettingsTable()) {
        const SettingValue value = getSetting(setting, settings);
        if (setting.name == "seed" || setting.name == "spp" || value == getSetting(setting, RenderSettings{})) continue;
        if (const bool* flag = std::get_if<bool>(&value); flag != nullptr)
            text += *flag ? " --" + std::string(setting.name) : " --set " + std::string(setting.name) + "=off";
        else
            text += " --" + std::string(setting.name) + " " + shellQuoted(settingText(value));
    }
    return text;
}

std::string shellQuoted(const std::string& text) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace raylab
