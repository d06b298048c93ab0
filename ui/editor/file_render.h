#pragma once

#include <filesystem>

#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"
#include "ui/editor/background.h"

namespace raylab {

/// Renders a scene on a device of its own until samples, time or error of the settings say stop, and writes the
/// picture: .png (exposure, tonemap) or .exr (radiance, variance, samples). Nothing is written where the job is
/// cancelled. Throws Error.
void renderImage(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                 const std::filesystem::path& path, JobControl& control);

}  // namespace raylab
