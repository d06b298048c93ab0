#include "ui/report/chart_configs.h"

#include <algorithm>
#include <array>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/render/device_defaults.h"
#include "engine/render/integrators.h"
#include "engine/render/tracer.h"
#include "ui/report/settings_file.h"
#include "ui/report/variations.h"

namespace raylab {
namespace {

/// What a set compares: lists of assignments to settings, NAME=VALUE, each a configuration.
using Assignments = std::vector<std::string>;

/// A set varies one setting, by the values or, without any, by all of its choices that are pictures of the scene; or it
/// has configurations of its own.
struct ChartSet {
    const char* name;
    const char* setting;
    std::vector<std::string> values;
    std::vector<Assignments> configs{};
};

const std::vector<ChartSet>& chartSets() {
    static const std::vector<ChartSet> sets = {
        {"methods", "integrator", {}},
        {"tracers", "tracer", {}},
        {"triangles", "triangle", {}},
        {"builders", "builder", {}},
        {"layouts", "layout", {}},
        {"depth", "depth", {"1", "2", "4", "10", "25"}},
        {"lights", "light-choice", {}},
        {"samplers", "sampler", {}},
        {"denoise", "denoise", {}},
        {"precision",
         "",
         {},
         {{"offset=error-bound", "slab=padded", "triangle=watertight"},
          {"offset=ulp"},
          {"offset=epsilon"},
          {"slab=plain"},
          {"triangle=minimal"},
          {"offset=epsilon", "slab=plain", "triangle=minimal"}}},
    };
    return sets;
}

const ChartSet& findSet(const std::string& name) {
    const auto set = std::ranges::find(chartSets(), name, &ChartSet::name);
    if (set == chartSets().end()) throw Error("there is no set of configurations '" + name + "'");
    return *set;
}

bool isComparable(const ChartSet& set, const std::string& value) {
    if (std::string_view(set.setting) == "integrator") return !findIntegrator(value).isView;
    return value != kAutoLayout;
}

std::vector<std::string> choicesOf(const ChartSet& set) {
    if (!set.values.empty()) return set.values;
    const Setting<RenderSettings>& setting = findSetting(renderSettingsTable(), set.setting);
    const bool isSwitch = std::holds_alternative<bool RenderSettings::*>(setting.member);
    return isSwitch ? std::vector<std::string>{"false", "true"} : setting.choices;
}

/// Values of a set that the device runs.
std::vector<std::string> valuesOf(const ChartSet& set, const DeviceDescription& device) {
    std::vector<std::string> values = choicesOf(set);
    std::erase_if(values, [&](const std::string& value) { return !isComparable(set, value); });
    if (std::string_view(set.setting) != "tracer") return values;
    std::erase_if(values, [&](const std::string& value) {
        const std::string missing = missingForTracer(value, device);
        if (!missing.empty()) logInfo("tracer " + value + " is left out: " + device.name + " lacks " + missing);
        return !missing.empty();
    });
    return values;
}

std::vector<Assignments> configsOf(const std::string& name, const DeviceDescription& device) {
    const std::string missing = missingForChartSet(name);
    if (!missing.empty()) throw Error("--set-of " + name + ": " + missing);
    const ChartSet& set = findSet(name);
    std::vector<Assignments> configs = set.configs;
    if (configs.empty())
        for (const std::string& value : valuesOf(set, device))
            configs.push_back({std::string(set.setting) + "=" + value});
    return configs;
}

void addConfig(std::vector<ChartConfig>& configs, const std::string& name, const RenderSettings& settings) {
    if (name.empty() || name.find_first_of("\r\n") != std::string::npos)
        throw Error("a configuration's name is one line of text, not '" + name + "'");
    if (std::ranges::find(configs, name, &ChartConfig::name) != configs.end())
        throw Error("two configurations are named '" + name + "'; give them names of their own");
    configs.push_back({name, settings});
}

/// [{"name": "...", "settings": {...}}, ...]; a name may be missing where settings tell enough.
std::vector<ChartConfig> readConfigs(const std::string& file, const RenderSettings& base) {
    const nlohmann::json json = readJsonFile(file);
    const nlohmann::json list = json.is_object() && json.contains("configs") ? json["configs"] : json;
    if (!list.is_array() || list.empty())
        throw Error(file +
                    ": is no list of configurations, such as [{\"name\": \"short\", \"settings\": {\"depth\": 2}}]");
    std::vector<ChartConfig> configs;
    for (const nlohmann::json& entry : list) {
        if (!entry.is_object() || !entry.contains("settings") || (entry.contains("name") && !entry["name"].is_string()))
            throw Error(file + ": a configuration is an object with \"settings\" and, as a text, \"name\"");
        RenderSettings settings = base;
        applySettings(settings, entry["settings"], file);
        std::string name = entry.value("name", std::string());
        if (name.empty())
            for (const auto& [key, value] : entry["settings"].items())
                name += (name.empty() ? "" : " ") + key + "=" +
                        (value.is_string() ? value.get<std::string>() : value.dump());
        addConfig(configs, name, settings);
    }
    return configs;
}

/// Each configuration, or the base where there is none yet, in every combination of the axes.
std::vector<ChartConfig> vary(const std::vector<ChartConfig>& configs, const RenderSettings& base,
                              const std::vector<std::string>& axes) {
    if (configs.empty() && axes.empty()) return {{"default", base}};
    std::vector<ChartConfig> result;
    const std::vector<ChartConfig> start = configs.empty() ? std::vector<ChartConfig>{{"", base}} : configs;
    for (const ChartConfig& config : start)
        for (const Variation& variation : gridOf(config.settings, axes)) {
            const std::string text = variation.text();
            const std::string separator = config.name.empty() || text.empty() ? "" : " ";
            addConfig(result, config.name + separator + text, variation.settings);
        }
    return result;
}

}  // namespace

std::vector<std::string> chartSetNames() {
    std::vector<std::string> names;
    for (const ChartSet& set : chartSets()) names.emplace_back(set.name);
    return names;
}

std::string missingForChartSet(const std::string& name) {
    const ChartSet& set = findSet(name);
    const auto isIts = [&](const Setting<RenderSettings>& row) { return row.name == set.setting; };
    if (!set.configs.empty() || std::ranges::any_of(renderSettingsTable(), isIts)) return {};
    return "there is no setting '" + std::string(set.setting) + "' in this raylab yet; choose another set";
}

std::vector<ChartConfig> chartConfigs(const RenderSettings& base, const ChartRequest& request,
                                      const DeviceDescription& device, const Scene& scene) {
    std::vector<ChartConfig> configs;
    if (!request.file.empty()) configs = readConfigs(request.file, base);
    for (const std::string& set : request.sets)
        for (const Assignments& assignments : configsOf(set, device))
            for (const Variation& variation : gridOf(base, assignments))
                addConfig(configs, variation.text(), variation.settings);
    configs = vary(configs, base, request.vary);
    for (ChartConfig& config : configs) {
        config.settings = resolveForDevice(config.settings, device, scene);
        const std::string missing = missingForTracer(config.settings.tracer, device);
        if (!missing.empty())
            throw Error(
                config.name + ": " + device.name + " lacks " + missing + " for --tracer " + config.settings.tracer,
                ExitCode::noDevice);
    }
    return configs;
}

}  // namespace raylab
