#include <algorithm>
#include <array>

#include "engine/core/error.h"
#include "engine/measure/stability/battery.h"
#include "engine/render/device_defaults.h"
#include "engine/render/tracer.h"

namespace raylab::stability {
namespace {

struct AxisInfo {
    std::string_view set;
    unsigned axis;
    std::string setting;
};

const std::array<AxisInfo, 5>& axisTable() {
    static const std::array<AxisInfo, 5> table = {{{"triangles", kAxisTriangle, "triangle"},
                                                   {"slabs", kAxisSlab, "slab"},
                                                   {"offsets", kAxisOffset, "offset"},
                                                   {"layouts", kAxisLayout, "layout"},
                                                   {"tracers", kAxisTracer, "tracer"}}};
    return table;
}

const Setting<RenderSettings>& rowOf(const std::string& setting) { return findSetting(renderSettingsTable(), setting); }

std::string valueOf(const RenderSettings& settings, const std::string& setting) {
    return settingText(getSetting(rowOf(setting), settings));
}

/// `config` with another value of one setting.
Config varied(const Config& config, const AxisInfo& axis, const std::string& value, const DeviceDescription& device) {
    Config other = config;
    setSetting(rowOf(axis.setting), other.settings, value);
    other.name = (config.isDefault() ? "" : config.name + ", ") + axis.setting + " " + value;
    other.axes |= value == "brute" ? kAxisBrute : axis.axis;
    if (axis.axis == kAxisTracer) other.missing = missingForTracer(value, device);
    return other;
}

/// All values of the axis but the one that `config` has.
std::vector<Config> others(const Config& config, const AxisInfo& axis, const DeviceDescription& device) {
    std::vector<Config> result;
    for (const std::string& value : rowOf(axis.setting).choices)
        if (value != valueOf(config.settings, axis.setting) && value != kAutoLayout)
            result.push_back(varied(config, axis, value, device));
    return result;
}

void append(std::vector<Config>& to, const std::vector<Config>& configs) {
    to.insert(to.end(), configs.begin(), configs.end());
}

}  // namespace

std::vector<std::string> configSets() {
    std::vector<std::string> sets = {"default"};
    for (const AxisInfo& axis : axisTable()) sets.emplace_back(axis.set);
    sets.insert(sets.end(), {"all", "product"});
    return sets;
}

std::vector<Config> configsOf(const std::string& set, const DeviceDescription& device) {
    if (std::ranges::count(configSets(), set) == 0) throw Error("there is no set of configurations '" + set + "'");
    const Config standard{"default", resolveForDevice({}, device), kAxisNone, ""};
    std::vector<Config> configs = {standard};
    for (const AxisInfo& axis : axisTable()) {
        if (set == axis.set || set == "all" || (set == "product" && axis.axis == kAxisTracer))
            append(configs, others(standard, axis, device));
        if (set != "product" || axis.axis == kAxisTracer) continue;
        for (const Config& config : std::vector<Config>(configs)) append(configs, others(config, axis, device));
    }
    return configs;
}

}  // namespace raylab::stability
