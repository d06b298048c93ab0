#pragma once

#include <vulkan/vulkan.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/gpu/buffer.h"

namespace raylab {

struct SpecConstant {
    uint32_t id = 0;
    uint32_t value = 0;

    bool operator==(const SpecConstant&) const = default;
};

/// A descriptor binding of a kernel.
struct BindingInfo {
    uint32_t binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
};

/// One descriptor set and the layout of the pipelines that use it, with a push constant block at offset 0.
struct KernelLayout {
    KernelLayout() = default;
    /// `stages`: that see the descriptors and the push constants.
    KernelLayout(const Device& device, std::span<const BindingInfo> bindings, uint32_t pushBytes,
                 VkShaderStageFlags stages = VK_SHADER_STAGE_COMPUTE_BIT);

    VkShaderStageFlags stages = 0;
    uint32_t pushBytes = 0;
    DescriptorSetLayoutHandle setLayout;
    PipelineLayoutHandle pipelineLayout;
    DescriptorPoolHandle pool;
    VkDescriptorSet set = VK_NULL_HANDLE;  ///< lives as long as the pool
};

void bindBuffer(const Device& device, const KernelLayout& layout, const BindingInfo& binding, VkBuffer buffer,
                size_t offsetBytes, size_t rangeBytes);
void bindTexelView(const Device& device, const KernelLayout& layout, uint32_t binding, VkBufferView view);
void bindStructure(const Device& device, const KernelLayout& layout, uint32_t binding,
                   VkAccelerationStructureKHR structure);

/// A pipeline, and how groups of lanes are launched on it.
struct Kernel {
    PipelineHandle pipeline;
    VkPipelineBindPoint bindPoint = VK_PIPELINE_BIND_POINT_COMPUTE;
    uint32_t lanesPerGroup = 0;  ///< of a ray tracing pipeline: rays generated for a group
    Buffer table;                ///< shader binding table of a ray tracing pipeline
    VkStridedDeviceAddressRegionKHR raygen{}, miss{}, hit{};

    explicit operator bool() const { return static_cast<bool>(pipeline); }
};

/// A compute kernel from a SPIR-V file. Throws Error where the file is missing.
Kernel makeComputeKernel(const Device& device, const KernelLayout& layout, const std::filesystem::path& spirv,
                         std::span<const SpecConstant> constants);

/// SPIR-V files of the stages of a ray tracing pipeline. In a hit group an empty path is no shader; with an intersection
/// shader it is of boxes.
struct RayTracingStages {
    struct HitGroup {
        std::filesystem::path closestHit, anyHit, intersection;
    };
    std::filesystem::path raygen;
    std::vector<std::filesystem::path> miss;
    std::vector<HitGroup> hit;
};

/// A ray tracing pipeline of recursion depth 1, with the specialisation constants in all stages, and its shader binding
/// table: records in the order of the groups. On a device that hasPipeline(). Throws Error where a file is missing.
Kernel makeRayTracingKernel(Device& device, const KernelLayout& layout, const RayTracingStages& stages,
                            uint32_t lanesPerGroup, std::span<const SpecConstant> constants);

/// Records the launch of groups 0 .. groups - 1. `push`: KernelLayout::pushBytes bytes.
void launch(const Device& device, VkCommandBuffer commands, const KernelLayout& layout, const Kernel& kernel,
            std::span<const uint32_t> dynamicOffsets, const void* push, uint32_t groups);
/// The same for a compute kernel whose groups a VkDispatchIndirectCommand counts.
void launchIndirect(VkCommandBuffer commands, const KernelLayout& layout, const Kernel& kernel,
                    std::span<const uint32_t> dynamicOffsets, const void* push, VkBuffer arguments, size_t offsetBytes);

}  // namespace raylab
