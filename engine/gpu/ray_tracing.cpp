#include "engine/gpu/ray_tracing.h"

#include <algorithm>
#include <cstring>

#include "engine/core/error.h"
#include "engine/gpu/check.h"

namespace raylab {
namespace {

std::vector<VkExtensionProperties> extensionsOf(VkPhysicalDevice device) {
    uint32_t count = 0;
    check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
          "vkEnumerateDeviceExtensionProperties");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()),
          "vkEnumerateDeviceExtensionProperties");
    return extensions;
}

bool contains(const std::vector<VkExtensionProperties>& extensions, const char* name) {
    return std::ranges::any_of(extensions,
                               [&](const VkExtensionProperties& e) { return std::strcmp(e.extensionName, name) == 0; });
}

template <class Function>
void load(VkDevice device, const char* name, Function& function) {
    function = reinterpret_cast<Function>(vkGetDeviceProcAddr(device, name));
    if (function == nullptr)
        throw Error(std::string("the driver offers ray tracing but not ") + name, ExitCode::noDevice);
}

}  // namespace

RayTracingOffer rayTracingOffer(VkPhysicalDevice device) {
    const std::vector<VkExtensionProperties> extensions = extensionsOf(device);
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR pipeline{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR};
    VkPhysicalDeviceRayQueryFeaturesKHR query{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR};
    VkPhysicalDeviceBufferDeviceAddressFeatures address{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES};
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
    const auto chain = [&](const char* extension, auto& part) {
        if (!contains(extensions, extension)) return;
        part.pNext = features.pNext;
        features.pNext = &part;
    };
    features.pNext = &address;
    chain(VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, structures);
    chain(VK_KHR_RAY_QUERY_EXTENSION_NAME, query);
    chain(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME, pipeline);
    vkGetPhysicalDeviceFeatures2(device, &features);

    std::string common;
    if (!contains(extensions, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME))
        common = VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME;
    else if (!structures.accelerationStructure)
        common = VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME;
    else if (!address.bufferDeviceAddress)
        common = "bufferDeviceAddress";
    RayTracingOffer offer{common, common};
    if (common.empty() && !query.rayQuery) offer.queryMissing = VK_KHR_RAY_QUERY_EXTENSION_NAME;
    if (common.empty() && !pipeline.rayTracingPipeline)
        offer.pipelineMissing = VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME;
    return offer;
}

RayTracingRequest::RayTracingRequest(const RayTracingOffer& offer) {
    if (!offer.hasStructures()) return;
    extensions_ = {VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME};
    address_.bufferDeviceAddress = VK_TRUE;
    structures_.accelerationStructure = VK_TRUE;
    structures_.pNext = &address_;
    features_ = &structures_;
    const auto chain = [&](const char* extension, auto& part) {
        extensions_.push_back(extension);
        part.pNext = const_cast<void*>(features_);
        features_ = &part;
    };
    if (offer.hasQuery()) {
        query_.rayQuery = VK_TRUE;
        chain(VK_KHR_RAY_QUERY_EXTENSION_NAME, query_);
    }
    if (offer.hasPipeline()) {
        pipeline_.rayTracingPipeline = VK_TRUE;
        chain(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME, pipeline_);
    }
}

RayTracing loadRayTracing(VkPhysicalDevice physical, VkDevice device, const RayTracingOffer& offer) {
    RayTracing rt;
    rt.offer = offer;
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &rt.structureLimits;
    if (offer.hasPipeline()) rt.structureLimits.pNext = &rt.pipelineLimits;
    vkGetPhysicalDeviceProperties2(physical, &properties);
    rt.structureLimits.pNext = nullptr;
    load(device, "vkCreateAccelerationStructureKHR", rt.createStructure);
    load(device, "vkDestroyAccelerationStructureKHR", rt.destroyStructure);
    load(device, "vkGetAccelerationStructureBuildSizesKHR", rt.buildSizes);
    load(device, "vkGetAccelerationStructureDeviceAddressKHR", rt.structureAddress);
    load(device, "vkCmdBuildAccelerationStructuresKHR", rt.build);
    load(device, "vkCmdCopyAccelerationStructureKHR", rt.copy);
    load(device, "vkCmdWriteAccelerationStructuresPropertiesKHR", rt.writeProperties);
    if (!offer.hasPipeline()) return rt;
    load(device, "vkCreateRayTracingPipelinesKHR", rt.createPipelines);
    load(device, "vkGetRayTracingShaderGroupHandlesKHR", rt.groupHandles);
    load(device, "vkCmdTraceRaysKHR", rt.traceRays);
    return rt;
}

}  // namespace raylab
