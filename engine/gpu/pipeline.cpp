#include "engine/gpu/pipeline.h"

#include <cstring>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/gpu/check.h"

namespace raylab {

KernelLayout::KernelLayout(const Device& device, std::span<const BindingInfo> bindings, uint32_t pushBytes) {
    std::vector<VkDescriptorSetLayoutBinding> layoutBindings;
    std::vector<VkDescriptorPoolSize> sizes;
    for (const BindingInfo& info : bindings) {
        layoutBindings.push_back({info.binding, info.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
        sizes.push_back({info.type, 1});
    }
    VkDescriptorSetLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    layoutInfo.bindingCount = static_cast<uint32_t>(layoutBindings.size());
    layoutInfo.pBindings = layoutBindings.data();
    VkDescriptorSetLayout layoutObject = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device.get(), &layoutInfo, nullptr, &layoutObject), "vkCreateDescriptorSetLayout");
    setLayout = {device.get(), layoutObject};

    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, pushBytes};
    VkPipelineLayoutCreateInfo pipelineInfo{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
    pipelineInfo.setLayoutCount = 1;
    pipelineInfo.pSetLayouts = &layoutObject;
    pipelineInfo.pushConstantRangeCount = 1;
    pipelineInfo.pPushConstantRanges = &push;
    VkPipelineLayout pipelineObject = VK_NULL_HANDLE;
    check(vkCreatePipelineLayout(device.get(), &pipelineInfo, nullptr, &pipelineObject), "vkCreatePipelineLayout");
    pipelineLayout = {device.get(), pipelineObject};

    VkDescriptorPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO};
    poolInfo.maxSets = 1;
    poolInfo.poolSizeCount = static_cast<uint32_t>(sizes.size());
    poolInfo.pPoolSizes = sizes.data();
    VkDescriptorPool poolObject = VK_NULL_HANDLE;
    check(vkCreateDescriptorPool(device.get(), &poolInfo, nullptr, &poolObject), "vkCreateDescriptorPool");
    pool = {device.get(), poolObject};

    VkDescriptorSetAllocateInfo allocate{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO};
    allocate.descriptorPool = poolObject;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &layoutObject;
    check(vkAllocateDescriptorSets(device.get(), &allocate, &set), "vkAllocateDescriptorSets");
}

void bindBuffer(const Device& device, const KernelLayout& layout, const BindingInfo& binding, VkBuffer buffer,
                size_t offsetBytes, size_t rangeBytes) {
    const VkDescriptorBufferInfo info{buffer, offsetBytes, rangeBytes};
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = layout.set;
    write.dstBinding = binding.binding;
    write.descriptorCount = 1;
    write.descriptorType = binding.type;
    write.pBufferInfo = &info;
    vkUpdateDescriptorSets(device.get(), 1, &write, 0, nullptr);
}

void bindTexelView(const Device& device, const KernelLayout& layout, uint32_t binding, VkBufferView view) {
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.dstSet = layout.set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    write.pTexelBufferView = &view;
    vkUpdateDescriptorSets(device.get(), 1, &write, 0, nullptr);
}

PipelineHandle makeComputePipeline(const Device& device, const KernelLayout& layout, const std::filesystem::path& spirv,
                                   std::span<const SpecConstant> constants) {
    const std::vector<std::byte> bytes = readFile(spirv);
    if (bytes.size() % 4 != 0) throw Error(spirv.string() + ": is not SPIR-V; reinstall raylab", ExitCode::internalError);
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    VkShaderModuleCreateInfo moduleInfo{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    moduleInfo.codeSize = bytes.size();
    moduleInfo.pCode = words.data();
    VkShaderModule moduleObject = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.get(), &moduleInfo, nullptr, &moduleObject), "vkCreateShaderModule");
    const ShaderModuleHandle module(device.get(), moduleObject);

    std::vector<VkSpecializationMapEntry> entries;
    std::vector<uint32_t> values;
    for (const SpecConstant& constant : constants) {
        entries.push_back({constant.id, static_cast<uint32_t>(values.size() * sizeof(uint32_t)), sizeof(uint32_t)});
        values.push_back(constant.value);
    }
    const VkSpecializationInfo specialisation{static_cast<uint32_t>(entries.size()), entries.data(),
                                              values.size() * sizeof(uint32_t), values.data()};
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = moduleObject;
    info.stage.pName = "main";
    info.stage.pSpecializationInfo = &specialisation;
    info.layout = layout.pipelineLayout.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device.get(), device.pipelineCache(), 1, &info, nullptr, &pipeline),
          ("vkCreateComputePipelines " + spirv.filename().string()).c_str());
    device.setName(pipeline, VK_OBJECT_TYPE_PIPELINE, spirv.filename().string());
    return {device.get(), pipeline};
}

}  // namespace raylab
