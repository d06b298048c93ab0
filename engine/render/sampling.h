#pragma once

#include <string>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/render/render_settings.h"
#include "shaders/shared/frame.h"

namespace raylab {

/// Samplers and pixel filters (shaders/lib/sampler.glsl, filter.glsl), as the settings call them.
std::vector<std::string> samplerNames();
std::vector<std::string> filterNames();

/// The fields of sampler, filter and clamp. Throws Error where the stratified sampler is asked for more samples than it
/// counts.
void writeSampling(const RenderSettings& settings, shared::FrameParams& frame);

/// The mask of the blue-noise sampler on the device; empty for the others.
TexelBuffer makeSamplerMask(Device& device, const RenderSettings& settings);

}  // namespace raylab
