#include "engine/gpu/shader_module.h"

#include "engine/gpu/check.h"
#include "engine/gpu/specialise.h"

namespace raylab {

ShaderModuleHandle loadModule(const Device& device, const std::filesystem::path& spirv,
                              std::span<const SpecConstant> constants) {
    const std::vector<uint32_t> code = specialisedCode(spirv, constants, kernelCache());
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = code.size() * sizeof(uint32_t);
    info.pCode = code.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.get(), &info, nullptr, &module), "vkCreateShaderModule");
    return {device.get(), module};
}

VkPipelineShaderStageCreateInfo stageInfo(VkShaderStageFlagBits stage, VkShaderModule module) {
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    return info;
}

}  // namespace raylab
