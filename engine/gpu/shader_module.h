#pragma once

#include <filesystem>
#include <vector>

#include "engine/gpu/pipeline.h"

namespace raylab {

/// Throws Error where the file is missing or is not SPIR-V.
ShaderModuleHandle loadModule(const Device& device, const std::filesystem::path& spirv);

/// Constants as a pipeline's stage wants them; info() points into this object.
class Specialisation {
public:
    explicit Specialisation(std::span<const SpecConstant> constants);
    Specialisation(const Specialisation&) = delete;
    Specialisation& operator=(const Specialisation&) = delete;
    const VkSpecializationInfo* info() const { return &info_; }

private:
    std::vector<VkSpecializationMapEntry> entries_;
    std::vector<uint32_t> values_;
    VkSpecializationInfo info_{};
};

/// Both must outlive the creation of the pipeline.
VkPipelineShaderStageCreateInfo stageInfo(VkShaderStageFlagBits stage, VkShaderModule module,
                                          const Specialisation& specialisation);

}  // namespace raylab
