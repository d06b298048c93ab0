#include "engine/gpu/shader_module.h"

#include <cstring>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/gpu/check.h"

namespace raylab {

ShaderModuleHandle loadModule(const Device& device, const std::filesystem::path& spirv) {
    const std::vector<std::byte> bytes = readFile(spirv);
    if (bytes.size() % 4 != 0)
        throw Error(spirv.string() + ": is not SPIR-V; reinstall raylab", ExitCode::internalError);
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = bytes.size();
    info.pCode = words.data();
    VkShaderModule module = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.get(), &info, nullptr, &module), "vkCreateShaderModule");
    return {device.get(), module};
}

Specialisation::Specialisation(std::span<const SpecConstant> constants) {
    for (const SpecConstant& constant : constants) {
        entries_.push_back({constant.id, static_cast<uint32_t>(values_.size() * sizeof(uint32_t)), sizeof(uint32_t)});
        values_.push_back(constant.value);
    }
    info_ = {static_cast<uint32_t>(entries_.size()), entries_.data(), values_.size() * sizeof(uint32_t),
             values_.data()};
}

VkPipelineShaderStageCreateInfo stageInfo(VkShaderStageFlagBits stage, VkShaderModule module,
                                          const Specialisation& specialisation) {
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    info.pSpecializationInfo = specialisation.info();
    return info;
}

}  // namespace raylab
