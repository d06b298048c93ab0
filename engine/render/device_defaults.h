#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/gpu/device.h"
#include "engine/render/render_settings.h"

namespace raylab {

/// Where `raylab bench --tune` records what is best on each device: $XDG_CONFIG_HOME/raylab/devices.json, or
/// ~/.config/raylab/devices.json; empty where the environment names neither.
std::filesystem::path deviceDefaultsFile();

/// The layout that is recorded for the device (by name and driver version), or kDefaultLayout. A file that is torn,
/// unreadable or names a layout that there is none of is warned of and ignored.
std::string layoutForDevice(const DeviceDescription& device);

/// Records the layout for the device and leaves the others as they are; written atomically. Throws Error where there is
/// no such layout, where deviceDefaultsFile() is empty, and where it cannot be written.
void recordLayout(const DeviceDescription& device, std::string_view layout);

/// The settings with "auto" replaced by what it stands for on this device, for this scene: bvh2 where layoutForScene()
/// says so. Without a scene, for one that is not tiny.
RenderSettings resolveForDevice(RenderSettings settings, const DeviceDescription& device);
RenderSettings resolveForDevice(RenderSettings settings, const DeviceDescription& device, const Scene& scene);

}  // namespace raylab
