#pragma once

#include <vulkan/vulkan.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/gpu/device.h"

namespace raylab {

struct SpecConstant {
    uint32_t id = 0;
    uint32_t value = 0;
};

/// A descriptor binding of a compute kernel.
struct BindingInfo {
    uint32_t binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
};

/// One descriptor set and the layout of the pipelines that use it, with a push constant block at offset 0.
struct KernelLayout {
    KernelLayout() = default;
    KernelLayout(const Device& device, std::span<const BindingInfo> bindings, uint32_t pushBytes);

    DescriptorSetLayoutHandle setLayout;
    PipelineLayoutHandle pipelineLayout;
    DescriptorPoolHandle pool;
    VkDescriptorSet set = VK_NULL_HANDLE;  ///< lives as long as the pool
};

void bindBuffer(const Device& device, const KernelLayout& layout, const BindingInfo& binding, VkBuffer buffer,
                size_t offsetBytes, size_t rangeBytes);
void bindTexelView(const Device& device, const KernelLayout& layout, uint32_t binding, VkBufferView view);

/// A compute pipeline from a SPIR-V file of the shaders folder. Throws Error where the file is missing.
PipelineHandle makeComputePipeline(const Device& device, const KernelLayout& layout, const std::filesystem::path& spirv,
                                   std::span<const SpecConstant> constants);

}  // namespace raylab
