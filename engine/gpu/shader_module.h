#pragma once

#include <filesystem>
#include <span>

#include "engine/gpu/pipeline.h"

namespace raylab {

/// Of the file's code, specialised (engine/gpu/specialise.h). Throws Error where the file is missing or is not SPIR-V.
ShaderModuleHandle loadModule(const Device& device, const std::filesystem::path& spirv,
                              std::span<const SpecConstant> constants);

/// The module must outlive the creation of the pipeline.
VkPipelineShaderStageCreateInfo stageInfo(VkShaderStageFlagBits stage, VkShaderModule module);

}  // namespace raylab
