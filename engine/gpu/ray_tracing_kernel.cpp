#include <algorithm>
#include <cstring>

#include "engine/gpu/check.h"
#include "engine/gpu/shader_module.h"

namespace raylab {
namespace {

/// The stages and groups of a pipeline while it is put together. A file that several groups name is loaded once.
class Assembly {
public:
    Assembly(const Device& device, std::span<const SpecConstant> constants) : device_(device), constants_(constants) {}

    void addGeneral(VkShaderStageFlagBits stage, const std::filesystem::path& spirv) {
        VkRayTracingShaderGroupCreateInfoKHR group = emptyGroup(VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR);
        group.generalShader = stageOf(stage, spirv);
        groups_.push_back(group);
    }

    void addHit(const RayTracingStages::HitGroup& hit) {
        VkRayTracingShaderGroupCreateInfoKHR group =
            emptyGroup(hit.intersection.empty() ? VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR
                                                : VK_RAY_TRACING_SHADER_GROUP_TYPE_PROCEDURAL_HIT_GROUP_KHR);
        group.closestHitShader = stageOf(VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, hit.closestHit);
        group.anyHitShader = stageOf(VK_SHADER_STAGE_ANY_HIT_BIT_KHR, hit.anyHit);
        group.intersectionShader = stageOf(VK_SHADER_STAGE_INTERSECTION_BIT_KHR, hit.intersection);
        groups_.push_back(group);
    }

    PipelineHandle make(const KernelLayout& layout, const std::string& name) const {
        VkRayTracingPipelineCreateInfoKHR info{VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR};
        info.stageCount = static_cast<uint32_t>(stages_.size());
        info.pStages = stages_.data();
        info.groupCount = groupCount();
        info.pGroups = groups_.data();
        info.maxPipelineRayRecursionDepth = 1;
        info.layout = layout.pipelineLayout.get();
        VkPipeline pipeline = VK_NULL_HANDLE;
        check(device_.rayTracing().createPipelines(device_.get(), VK_NULL_HANDLE, device_.pipelineCache(), 1, &info,
                                                   nullptr, &pipeline),
              ("vkCreateRayTracingPipelinesKHR " + name).c_str());
        device_.setName(pipeline, VK_OBJECT_TYPE_PIPELINE, name);
        return {device_.get(), pipeline};
    }

    uint32_t groupCount() const { return static_cast<uint32_t>(groups_.size()); }

private:
    static VkRayTracingShaderGroupCreateInfoKHR emptyGroup(VkRayTracingShaderGroupTypeKHR type) {
        VkRayTracingShaderGroupCreateInfoKHR group{VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR};
        group.type = type;
        group.generalShader = VK_SHADER_UNUSED_KHR;
        group.closestHitShader = VK_SHADER_UNUSED_KHR;
        group.anyHitShader = VK_SHADER_UNUSED_KHR;
        group.intersectionShader = VK_SHADER_UNUSED_KHR;
        return group;
    }

    uint32_t stageOf(VkShaderStageFlagBits stage, const std::filesystem::path& spirv) {
        if (spirv.empty()) return VK_SHADER_UNUSED_KHR;
        const auto known = std::ranges::find(files_, spirv);
        if (known != files_.end()) return static_cast<uint32_t>(known - files_.begin());
        files_.push_back(spirv);
        modules_.push_back(loadModule(device_, spirv, constants_));
        stages_.push_back(stageInfo(stage, modules_.back().get()));
        return static_cast<uint32_t>(stages_.size()) - 1;
    }

    const Device& device_;
    std::span<const SpecConstant> constants_;
    std::vector<std::filesystem::path> files_;
    std::vector<ShaderModuleHandle> modules_;
    std::vector<VkPipelineShaderStageCreateInfo> stages_;
    std::vector<VkRayTracingShaderGroupCreateInfoKHR> groups_;
};

size_t alignUp(size_t value, size_t alignment) { return (value + alignment - 1) / alignment * alignment; }

/// Regions of ray generation (one record), miss and hit records, each aligned as its base must be.
void makeTable(Device& device, uint32_t groupCount, uint32_t missCount, Kernel& kernel) {
    const VkPhysicalDeviceRayTracingPipelinePropertiesKHR& limits = device.rayTracing().pipelineLimits;
    const size_t handleBytes = limits.shaderGroupHandleSize;
    const size_t stride = alignUp(handleBytes, limits.shaderGroupHandleAlignment);
    const size_t base = limits.shaderGroupBaseAlignment;
    std::vector<std::byte> handles(groupCount * handleBytes);
    check(device.rayTracing().groupHandles(device.get(), kernel.pipeline.get(), 0, groupCount, handles.size(),
                                           handles.data()),
          "vkGetRayTracingShaderGroupHandlesKHR");
    const size_t missAt = alignUp(stride, base);
    const size_t hitAt = missAt + alignUp(missCount * stride, base);
    const size_t hitCount = groupCount - 1 - missCount;
    std::vector<std::byte> records(base + hitAt + hitCount * stride);
    kernel.table = Buffer(device, "shader binding table", records.size(),
                          VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                              VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                          BufferPlace::device);
    const VkDeviceAddress address = addressOf(device, kernel.table);
    const size_t first = alignUp(address, base) - address;
    for (uint32_t group = 0; group < groupCount; ++group) {
        const size_t at = group == 0           ? 0
                          : group <= missCount ? missAt + (group - 1) * stride
                                               : hitAt + (group - 1 - missCount) * stride;
        std::memcpy(&records[first + at], &handles[group * handleBytes], handleBytes);
    }
    upload(device, kernel.table, records);
    kernel.raygen = {address + first, stride, stride};
    kernel.miss = {address + first + missAt, stride, missCount * stride};
    kernel.hit = {address + first + hitAt, stride, hitCount * stride};
}

}  // namespace

Kernel makeRayTracingKernel(Device& device, const KernelLayout& layout, const RayTracingStages& stages,
                            uint32_t lanesPerGroup, std::span<const SpecConstant> constants) {
    Assembly assembly(device, constants);
    assembly.addGeneral(VK_SHADER_STAGE_RAYGEN_BIT_KHR, stages.raygen);
    for (const std::filesystem::path& miss : stages.miss) assembly.addGeneral(VK_SHADER_STAGE_MISS_BIT_KHR, miss);
    for (const RayTracingStages::HitGroup& hit : stages.hit) assembly.addHit(hit);
    Kernel kernel;
    kernel.bindPoint = VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR;
    kernel.lanesPerGroup = lanesPerGroup;
    kernel.pipeline = assembly.make(layout, stages.raygen.filename().string());
    makeTable(device, assembly.groupCount(), static_cast<uint32_t>(stages.miss.size()), kernel);
    return kernel;
}

}  // namespace raylab
