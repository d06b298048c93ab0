#include <iostream>

#include "engine/gpu/device.h"
#include "engine/render/tracer.h"
#include "ui/cli/commands.h"
#include "ui/cli/options.h"

namespace raylab {
namespace {

nlohmann::ordered_json tracersJson(const DeviceDescription& d) {
    nlohmann::ordered_json tracers;
    for (const std::string& name : tracerNames()) {
        const std::string missing = missingForTracer(name, d);
        tracers[name] = {{"runs", missing.empty()}, {"missing", missing}};
    }
    return tracers;
}

nlohmann::ordered_json deviceJson(const DeviceDescription& d) {
    return {{"index", d.index},
            {"name", d.name},
            {"driver", d.driver},
            {"kind", d.kind},
            {"apiVersion", versionText(d.apiVersion)},
            {"memoryBytes", d.memoryBytes},
            {"maxStorageBufferRange", d.maxStorageBufferRange},
            {"maxTexelBufferElements", d.maxTexelBufferElements},
            {"suitable", d.unsuitable.empty()},
            {"unsuitable", d.unsuitable},
            {"tracers", tracersJson(d)}};
}

std::string tracersText(const DeviceDescription& d) {
    std::string text;
    for (const std::string& name : tracerNames()) {
        const std::string missing = missingForTracer(name, d);
        text += (text.empty() ? "" : ", ") + name + (missing.empty() ? "" : " (no: " + missing + " is missing)");
    }
    return text;
}

ExitCode printDevices(const std::string& jsonPath) {
    const std::vector<DeviceDescription> devices = listDevices();
    if (!jsonPath.empty()) {
        nlohmann::ordered_json json{{"schema", "raylab.devices/1"}, {"devices", nlohmann::ordered_json::array()}};
        for (const DeviceDescription& device : devices) json["devices"].push_back(deviceJson(device));
        writeJson(jsonPath, json);
    }
    if (jsonPath != "-")
        for (const DeviceDescription& d : devices)
            std::cout << d.index << ": " << d.name << " (" << d.kind << ", " << d.driver << ", Vulkan " << versionText(d.apiVersion)
                      << ", " << (d.memoryBytes >> 20) << " MiB)"
                      << (d.unsuitable.empty() ? "\n   tracers: " + tracersText(d) : " unsuitable: " + d.unsuitable) << "\n";
    if (devices.empty()) throw Error("there is no Vulkan device; install mesa-vulkan-drivers", ExitCode::noDevice);
    return ExitCode::done;
}

}  // namespace

void addDevicesCommand(CLI::App& app, Command& chosen) {
    CLI::App* command = app.add_subcommand("devices", "list the Vulkan devices of this machine");
    const auto json = std::make_shared<std::string>();
    command->add_option("--json", *json, "write the list to a file, or - for standard output")->type_name("FILE");
    command->callback([&chosen, json] { chosen = [json] { return printDevices(*json); }; });
}

}  // namespace raylab
