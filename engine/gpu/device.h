#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/gpu/handle.h"
#include "engine/gpu/ray_tracing.h"

namespace raylab {

/// What `raylab devices` prints of a physical device.
struct DeviceDescription {
    uint32_t index = 0;
    std::string name;
    std::string driver;
    std::string kind;  ///< discrete, integrated, virtual, cpu or other
    uint32_t apiVersion = 0;
    uint64_t memoryBytes = 0;            ///< largest device-local heap
    uint64_t maxStorageBufferRange = 0;  ///< bytes
    uint64_t maxTexelBufferElements = 0;
    std::string unsuitable;      ///< why raylab cannot use it; empty where it can
    RayTracingOffer rayTracing;  ///< of hardware traversal
};

struct DeviceOptions {
    std::string selector;     ///< index or part of the name; empty: the fastest kind that is suitable
    bool validation = false;  ///< core and synchronisation validation; every message counts and is logged
    // Of a device that draws a window:
    bool graphics = false;  ///< the queue draws too, and the device keeps no pipelines on disk
    std::vector<const char*> instanceExtensions;
    std::vector<const char*> deviceExtensions;
};

std::string versionText(uint32_t apiVersion);

/// All Vulkan devices of this machine. Throws Error (exit code 3) where there is no Vulkan at all.
std::vector<DeviceDescription> listDevices();

/// Instance, device, one queue that computes, and the immediate way to run commands on it. Needs Vulkan 1.2 and neither
/// an extension nor an optional feature beyond those asked for; what there is of hardware traversal is enabled. Not
/// thread-safe.
class Device {
public:
    /// Throws Error (exit code 3) where no device is suitable or the selector matches none.
    explicit Device(const DeviceOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    VkDevice get() const { return device_; }
    VkInstance instance() const { return instance_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkQueue queue() const { return queue_; }
    uint32_t queueFamily() const { return queueFamily_; }
    const DeviceDescription& description() const { return description_; }
    const VkPhysicalDeviceLimits& limits() const { return properties_.limits; }
    /// Only where description().rayTracing.hasStructures().
    const RayTracing& rayTracing() const { return rayTracing_; }
    uint64_t maxAllocationBytes() const { return maxAllocationBytes_; }
    VkPipelineCache pipelineCache() const { return pipelineCache_.get(); }

    /// Index of a memory type with all of `wanted` among `typeBits`; -1 where there is none.
    int32_t findMemoryType(uint32_t typeBits, VkMemoryPropertyFlags wanted) const;

    /// Records commands, submits them and waits; what they write is visible to the host and to the next run. Returns the device's own time for them in seconds (wall time of the
    /// submission where the queue has no timestamps).
    double run(const char* label, const std::function<void(VkCommandBuffer)>& record);

    /// Gives an object a name for validation messages and captures; nothing without validation.
    template <class T>
    void setName(T object, VkObjectType type, const std::string& name) const {
        setObjectName(reinterpret_cast<uint64_t>(object), type, name);
    }

    /// Messages of the validation layers so far.
    uint32_t validationMessageCount() const { return validationMessages_; }

private:
    void destroy();
    void createInstance(const DeviceOptions& options);
    void choosePhysicalDevice(const std::string& selector);
    void createDevice(const DeviceOptions& options);
    void createCommandObjects();
    void loadPipelineCache();
    void savePipelineCache() const;
    void setObjectName(uint64_t object, VkObjectType type, const std::string& name) const;

    std::atomic<uint32_t> validationMessages_{0};
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    uint32_t queueFamily_ = 0;
    bool hasTimestamps_ = false;
    bool debugUtils_ = false;
    bool keepsPipelines_ = true;
    DeviceDescription description_;
    RayTracing rayTracing_;
    VkPhysicalDeviceProperties properties_{};
    VkPhysicalDeviceMemoryProperties memory_{};
    uint64_t maxAllocationBytes_ = 0;
    CommandPoolHandle commandPool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    FenceHandle fence_;
    QueryPoolHandle timestamps_;
    PipelineCacheHandle pipelineCache_;
};

}  // namespace raylab
