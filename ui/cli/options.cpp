#include "ui/cli/options.h"

#include "engine/core/error.h"
#include "engine/core/file.h"

namespace raylab {
namespace {

std::string helpOf(const Setting<RenderSettings>& setting) {
    std::string text(setting.help);
    for (size_t i = 0; i < setting.choices.size(); ++i) text += (i == 0 ? ": " : ", ") + setting.choices[i];
    const std::string standard = settingText(getSetting(setting, RenderSettings{}));
    if (!standard.empty()) text += " [" + standard + "]";
    return text;
}

}  // namespace

SettingOptions::SettingOptions(CLI::App& command) {
    for (const Setting<RenderSettings>& setting : renderSettingsTable()) {
        const std::string name(setting.name);
        const std::string flag = "--" + name;
        if (std::holds_alternative<bool RenderSettings::*>(setting.member)) {
            command.add_flag_callback(flag, [this, name] { named_.emplace_back(name, "on"); }, helpOf(setting));
            continue;
        }
        command
            .add_option_function<std::string>(
                flag, [this, name](const std::string& text) { named_.emplace_back(name, text); }, helpOf(setting))
            ->type_name(setting.unit.empty() ? "VALUE" : std::string(setting.unit));
    }
    command.add_option("--set", sets_, "any setting by name; may be repeated")->type_name("NAME=VALUE")->allow_extra_args(false);
    command.add_option("--preset", preset_, "settings from a JSON file, as raylab advise writes it; explicit options win")->type_name("FILE");
}

RenderSettings SettingOptions::resolve() const {
    RenderSettings settings;
    if (!preset_.empty()) applyPreset(settings, preset_);
    for (const auto& [name, text] : named_) setSetting(findSetting(renderSettingsTable(), name), settings, text);
    for (const std::string& assignment : sets_) {
        const size_t equals = assignment.find('=');
        if (equals == std::string::npos) throw Error("--set takes NAME=VALUE, not '" + assignment + "'");
        setSetting(findSetting(renderSettingsTable(), assignment.substr(0, equals)), settings, assignment.substr(equals + 1));
    }
    return settings;
}

std::filesystem::path scenePath(const std::string& text) {
    const std::filesystem::path path(text);
    if (std::filesystem::exists(path) || path.has_parent_path() || path.has_extension()) return path;
    const std::filesystem::path own = dataFolder("assets") / (text + ".glb");
    return std::filesystem::exists(own) ? own : path;
}

Metadata settingsMetadata(const RenderSettings& settings) {
    Metadata metadata;
    for (const Setting<RenderSettings>& setting : renderSettingsTable())
        metadata.emplace_back(setting.name, settingText(getSetting(setting, settings)));
    return metadata;
}

}  // namespace raylab
