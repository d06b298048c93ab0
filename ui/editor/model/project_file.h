#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"

namespace raylab::editor {

/// What stands beside a scene: the view, the settings that differ from their defaults, which instances are hidden.
struct Project {
    RenderSettings settings;
    std::optional<Camera> view;
    std::vector<uint8_t> hidden;  ///< one an instance, or empty
    std::vector<std::string> warnings;
};

/// "a/b.raylab.json" of "a/b.glb".
std::filesystem::path projectFile(const std::filesystem::path& sceneFile);

/// Written whole or not at all. `device` and `validation` are of a machine, not of a scene, and are left out. Throws
/// Error where it cannot be written.
void writeProject(const std::filesystem::path& file, const Project& project);

/// Defaults where there is no such file. A setting that is unknown or has a bad value, and hidden instances of a scene
/// that has another number of them by now, are left out with a warning. Throws Error for a file that is no project.
Project readProject(const std::filesystem::path& file, size_t instanceCount);

}  // namespace raylab::editor
