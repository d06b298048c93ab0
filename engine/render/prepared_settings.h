#pragma once

#include "engine/render/prepared_scene.h"

namespace raylab {

/// As updateShading(), and takes up all other settings that prepareScene() reads, but for those of the tracer and of
/// --needs: lights, ambient light, sampler, motion of the camera.
void updateSettings(Device& device, const Scene& scene, const RenderSettings& settings, PreparedScene& prepared,
                    const SceneParts& changed = {});

}  // namespace raylab
