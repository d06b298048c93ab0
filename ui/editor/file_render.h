#pragma once

#include <filesystem>

#include "engine/gpu/shader_sources.h"
#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"
#include "ui/editor/background.h"

namespace raylab {

/// Renders a scene on a device of its own until samples, time or error of the settings say stop, and writes the
/// picture: .png (exposure, tonemap) or .exr (radiance, variance, samples). Nothing is written where the job is
/// cancelled. Kernels are brought up to `shaders` before; where a source does not compile, a warning says so and those
/// that are there render. Throws Error.
void renderImage(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                 const std::filesystem::path& path, ShaderSources& shaders, JobControl& control);

}  // namespace raylab
