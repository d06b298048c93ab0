#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/render/render_settings.h"

namespace raylab {

nlohmann::ordered_json settingsJson(const RenderSettings& settings);

/// Writes to a file, or to standard output for "-".
void writeJson(const std::string& path, const nlohmann::ordered_json& json);

/// Throws Error, naming the file, where it cannot be read or is no JSON.
nlohmann::json readJsonFile(const std::string& path);

/// Sets what the object says, by name; values are texts, numbers or true and false. Throws Error, naming the file, for
/// what is no setting or no value of one.
void applySettings(RenderSettings& settings, const nlohmann::json& object, const std::string& file);

/// A preset is an object of settings, or a document with one under "settings": what raylab advise and render --json
/// write. Throws Error as the above do.
void applyPreset(RenderSettings& settings, const std::string& file);

/// The settings that differ from the defaults, as options of the command line: " --depth 4 --sampler independent". The
/// seed and the samples are left out.
std::string settingsAsOptions(const RenderSettings& settings);

/// In single quotes where a shell would take it apart.
std::string shellQuoted(const std::string& text);

}  // namespace raylab
