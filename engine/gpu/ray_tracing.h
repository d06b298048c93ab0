#pragma once

#include <vulkan/vulkan.h>

#include <string>
#include <vector>

namespace raylab {

/// Whether a physical device traces rays itself, by each of Vulkan's two ways. Either may be there without the other.
struct RayTracingOffer {
    std::string queryMissing;     ///< the extension or feature that ray queries lack; empty where they work
    std::string pipelineMissing;  ///< the same for ray tracing pipelines

    bool hasQuery() const { return queryMissing.empty(); }
    bool hasPipeline() const { return pipelineMissing.empty(); }
    bool hasStructures() const { return hasQuery() || hasPipeline(); }
};

/// For a device of Vulkan 1.2 or later.
RayTracingOffer rayTracingOffer(VkPhysicalDevice device);

/// What vkCreateDevice wants to know to enable all that is offered.
class RayTracingRequest {
public:
    explicit RayTracingRequest(const RayTracingOffer& offer);
    RayTracingRequest(const RayTracingRequest&) = delete;
    RayTracingRequest& operator=(const RayTracingRequest&) = delete;
    const std::vector<const char*>& extensions() const { return extensions_; }
    /// For VkDeviceCreateInfo::pNext; nullptr where there is nothing to enable. Points into this object.
    const void* features() const { return features_; }

private:
    std::vector<const char*> extensions_;
    const void* features_ = nullptr;
    VkPhysicalDeviceBufferDeviceAddressFeatures address_{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures_{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
    VkPhysicalDeviceRayQueryFeaturesKHR query_{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR pipeline_{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR};
};

/// The functions and limits of a device whose offer hasStructures(); those of the pipeline only where it hasPipeline().
struct RayTracing {
    RayTracingOffer offer;
    VkPhysicalDeviceAccelerationStructurePropertiesKHR structureLimits{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR};
    VkPhysicalDeviceRayTracingPipelinePropertiesKHR pipelineLimits{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR};
    PFN_vkCreateAccelerationStructureKHR createStructure = nullptr;
    PFN_vkDestroyAccelerationStructureKHR destroyStructure = nullptr;
    PFN_vkGetAccelerationStructureBuildSizesKHR buildSizes = nullptr;
    PFN_vkGetAccelerationStructureDeviceAddressKHR structureAddress = nullptr;
    PFN_vkCmdBuildAccelerationStructuresKHR build = nullptr;
    PFN_vkCmdCopyAccelerationStructureKHR copy = nullptr;
    PFN_vkCmdWriteAccelerationStructuresPropertiesKHR writeProperties = nullptr;
    PFN_vkCreateRayTracingPipelinesKHR createPipelines = nullptr;
    PFN_vkGetRayTracingShaderGroupHandlesKHR groupHandles = nullptr;
    PFN_vkCmdTraceRaysKHR traceRays = nullptr;
};

/// Throws Error where the driver lacks a function that it must have.
RayTracing loadRayTracing(VkPhysicalDevice physical, VkDevice device, const RayTracingOffer& offer);

}  // namespace raylab
