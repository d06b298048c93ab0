#pragma once

#include <string>
#include <vector>

#include "engine/gpu/pipeline.h"
#include "engine/render/render_settings.h"

namespace raylab {

/// Place of a setting's value among its choices: the numbers of shaders/shared are in that order. Throws Error where it is
/// none of them.
uint32_t choiceIndex(const RenderSettings& settings, const std::string& name);

/// What the kernel of a rendering is specialised to by the settings alone. Throws Error where a setting is none of its
/// choices.
std::vector<SpecConstant> renderConstants(const RenderSettings& settings);

}  // namespace raylab
