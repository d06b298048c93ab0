#pragma once

#include <vector>

#include "engine/gpu/pipeline.h"
#include "engine/render/render_settings.h"

namespace raylab {

/// What the kernel of a rendering is specialised to by the settings alone. Throws Error where a setting is none of its
/// choices.
std::vector<SpecConstant> renderConstants(const RenderSettings& settings);

}  // namespace raylab
