#include "engine/render/device_defaults.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "engine/accel/layout.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "raylab.device-defaults/1";

struct DeviceDefault {
    std::string device;
    std::string driver;
    std::string layout;

    bool isFor(const DeviceDescription& description) const {
        return device == description.name && driver == description.driver;
    }
};

/// Throws Error, or what the JSON library throws.
std::vector<DeviceDefault> readDefaults(const fs::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    const nlohmann::json json = nlohmann::json::parse(text, text + bytes.size());
    if (json.at("schema") != kSchema) throw Error("its schema is not " + std::string(kSchema));
    std::vector<DeviceDefault> defaults;
    for (const nlohmann::json& entry : json.at("devices")) {
        defaults.push_back({entry.at("device").get<std::string>(), entry.at("driver").get<std::string>(),
                            entry.at("layout").get<std::string>()});
        findLayout(defaults.back().layout);
    }
    return defaults;
}

std::vector<DeviceDefault> loadDefaults(const fs::path& path) {
    std::error_code code;
    if (path.empty() || fs::status(path, code).type() == fs::file_type::not_found) return {};
    try {
        return readDefaults(path);
    } catch (const std::exception& error) {
        logWarning(path.string() + " is ignored (" + error.what() + "); raylab bench --tune writes it anew");
        return {};
    }
}

}  // namespace

fs::path deviceDefaultsFile() {
    const char* const configHome = std::getenv("XDG_CONFIG_HOME");
    // The XDG base directory specification: a path that is not absolute is to be ignored.
    if (configHome != nullptr && fs::path(configHome).is_absolute())
        return fs::path(configHome) / "raylab" / "devices.json";
    const char* const home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') return fs::path(home) / ".config" / "raylab" / "devices.json";
    return {};
}

std::string layoutForDevice(const DeviceDescription& device) {
    const std::vector<DeviceDefault> defaults = loadDefaults(deviceDefaultsFile());
    const auto found = std::ranges::find_if(defaults, [&](const DeviceDefault& entry) { return entry.isFor(device); });
    return found != defaults.end() ? found->layout : std::string(kDefaultLayout);
}

void recordLayout(const DeviceDescription& device, std::string_view layout) {
    findLayout(layout);
    const fs::path path = deviceDefaultsFile();
    if (path.empty()) throw Error("neither XDG_CONFIG_HOME nor HOME says where to record what is best on this device");
    std::vector<DeviceDefault> defaults = loadDefaults(path);
    std::erase_if(defaults, [&](const DeviceDefault& entry) { return entry.isFor(device); });
    defaults.push_back({device.name, device.driver, std::string(layout)});
    nlohmann::ordered_json json{{"schema", kSchema}, {"devices", nlohmann::ordered_json::array()}};
    for (const DeviceDefault& entry : defaults)
        json["devices"].push_back({{"device", entry.device}, {"driver", entry.driver}, {"layout", entry.layout}});
    const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    writeFileAtomically(path, std::as_bytes(std::span(text)));
}

RenderSettings resolveForDevice(RenderSettings settings, const DeviceDescription& device) {
    if (settings.layout == kAutoLayout) settings.layout = layoutForDevice(device);
    return settings;
}

RenderSettings resolveForDevice(RenderSettings settings, const DeviceDescription& device, const Scene& scene) {
    if (settings.layout == kAutoLayout && isTiny(scene)) settings.layout = kTinyLayout;
    return resolveForDevice(std::move(settings), device);
}

}  // namespace raylab
