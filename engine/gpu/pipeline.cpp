#include "engine/gpu/pipeline.h"

#include "engine/gpu/check.h"
#include "engine/gpu/shader_module.h"

namespace raylab {
namespace {

void bindKernel(VkCommandBuffer commands, const KernelLayout& layout, const Kernel& kernel,
                std::span<const uint32_t> dynamicOffsets, const void* push) {
    vkCmdBindPipeline(commands, kernel.bindPoint, kernel.pipeline.get());
    vkCmdBindDescriptorSets(commands, kernel.bindPoint, layout.pipelineLayout.get(), 0, 1, &layout.set,
                            static_cast<uint32_t>(dynamicOffsets.size()), dynamicOffsets.data());
    vkCmdPushConstants(commands, layout.pipelineLayout.get(), layout.stages, 0, layout.pushBytes, push);
}

}  // namespace

KernelLayout::KernelLayout(const Device& device, std::span<const BindingInfo> bindings, uint32_t pushBytes_,
                           VkShaderStageFlags stages_)
    : stages(stages_), pushBytes(pushBytes_) {
    std::vector<VkDescriptorSetLayoutBinding> layoutBindings;
    std::vector<VkDescriptorPoolSize> sizes;
    for (const BindingInfo& info : bindings) {
        layoutBindings.push_back({info.binding, info.type, 1, stages, nullptr});
        sizes.push_back({info.type, 1});
    }
    VkDescriptorSetLayoutCreateInfo layoutInfo{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
    layoutInfo.bindingCount = static_cast<uint32_t>(layoutBindings.size());
    layoutInfo.pBindings = layoutBindings.data();
    VkDescriptorSetLayout layoutObject = VK_NULL_HANDLE;
    check(vkCreateDescriptorSetLayout(device.get(), &layoutInfo, nullptr, &layoutObject), "vkCreateDescriptorSetLayout");
    setLayout = {device.get(), layoutObject};

    const VkPushConstantRange push{stages, 0, pushBytes};
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

void bindStructure(const Device& device, const KernelLayout& layout, uint32_t binding,
                   VkAccelerationStructureKHR structure) {
    VkWriteDescriptorSetAccelerationStructureKHR info{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR};
    info.accelerationStructureCount = 1;
    info.pAccelerationStructures = &structure;
    VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    write.pNext = &info;
    write.dstSet = layout.set;
    write.dstBinding = binding;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    vkUpdateDescriptorSets(device.get(), 1, &write, 0, nullptr);
}

Kernel makeComputeKernel(const Device& device, const KernelLayout& layout, const std::filesystem::path& spirv,
                         std::span<const SpecConstant> constants) {
    const ShaderModuleHandle module = loadModule(device, spirv, constants);
    VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
    info.stage = stageInfo(VK_SHADER_STAGE_COMPUTE_BIT, module.get());
    info.layout = layout.pipelineLayout.get();
    VkPipeline pipeline = VK_NULL_HANDLE;
    check(vkCreateComputePipelines(device.get(), device.pipelineCache(), 1, &info, nullptr, &pipeline),
          ("vkCreateComputePipelines " + spirv.filename().string()).c_str());
    device.setName(pipeline, VK_OBJECT_TYPE_PIPELINE, spirv.filename().string());
    Kernel kernel;
    kernel.pipeline = {device.get(), pipeline};
    return kernel;
}

void launchIndirect(VkCommandBuffer commands, const KernelLayout& layout, const Kernel& kernel,
                    std::span<const uint32_t> dynamicOffsets, const void* push, VkBuffer arguments, size_t offsetBytes) {
    bindKernel(commands, layout, kernel, dynamicOffsets, push);
    vkCmdDispatchIndirect(commands, arguments, offsetBytes);
}

void launch(const Device& device, VkCommandBuffer commands, const KernelLayout& layout, const Kernel& kernel,
            std::span<const uint32_t> dynamicOffsets, const void* push, uint32_t groups) {
    bindKernel(commands, layout, kernel, dynamicOffsets, push);
    if (kernel.bindPoint == VK_PIPELINE_BIND_POINT_COMPUTE) {
        vkCmdDispatch(commands, groups, 1, 1);
        return;
    }
    const VkStridedDeviceAddressRegionKHR noCallables{};
    device.rayTracing().traceRays(commands, &kernel.raygen, &kernel.miss, &kernel.hit, &noCallables,
                                  groups * kernel.lanesPerGroup, 1, 1);
}

}  // namespace raylab
