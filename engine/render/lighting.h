#pragma once

#include "engine/render/render_settings.h"
#include "engine/scene/scene.h"

namespace raylab {

/// True where the scene itself gives light: a light, an emissive surface, an environment or a sky.
bool hasLight(const Scene& scene);

/// Settles scene.environment as the settings ask: the file's own, a computed sky, a constant, an image, or none; scaled, and
/// without values that are negative or not finite (counted in scene.warnings). Throws Error where an image cannot be read.
void settleEnvironment(Scene& scene, const RenderSettings& settings);

}  // namespace raylab
