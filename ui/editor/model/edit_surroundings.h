#pragma once

#include <filesystem>

#include "ui/editor/model/document.h"

/// Edits of what surrounds the scene, and of how it is rendered.
namespace raylab::editor {

/// Sun and sky, in place of a radiance map; angles, turbidity and scale are taken into the ranges of the file format
/// (docs/scene-format.md).
Edit setSky(const SkyDescription& sky, std::string mergeKey = {});

/// A latitude-longitude image (EXR, HDR, PNG, JPEG) in place of the sky; values that are negative or not finite count
/// as 0. Throws Error, before there is an edit, where it cannot be read.
Edit loadEnvironment(const std::filesystem::path& file);

/// Neither sky nor radiance map.
Edit removeSurroundings();

/// A row of renderSettingsTable(). Throws Error on apply for what the setting does not take.
Edit setRenderSetting(const std::string& name, const std::string& text, std::string mergeKey = {});

/// All settings at once, as one step.
Edit replaceRenderSettings(const RenderSettings& settings, const std::string& name);

}  // namespace raylab::editor
