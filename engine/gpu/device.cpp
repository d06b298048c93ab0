#include "engine/gpu/device.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/gpu/check.h"
#include "engine/gpu/instance.h"
#include "engine/gpu/simulated_failure.h"
#include "engine/gpu/submit.h"

namespace raylab {
namespace {

int rank(const DeviceDescription& description) {
    static constexpr std::array kinds = {"discrete", "integrated", "virtual", "cpu", "other"};
    return static_cast<int>(std::find(kinds.begin(), kinds.end(), description.kind) - kinds.begin());
}

bool matches(const DeviceDescription& description, const std::string& selector) {
    return selector == std::to_string(description.index) || description.name.find(selector) != std::string::npos;
}

std::string listText(const std::vector<DeviceDescription>& descriptions) {
    std::string text;
    for (const DeviceDescription& d : descriptions)
        text += "\n  " + std::to_string(d.index) + ": " + d.name +
                (d.unsuitable.empty() ? "" : " (unsuitable: " + d.unsuitable + ")");
    return text.empty() ? "\n  (none)" : text;
}

std::filesystem::path pipelineCachePath(const VkPhysicalDeviceProperties& properties) {
    std::string id;
    for (const uint8_t byte : properties.pipelineCacheUUID) {
        static constexpr char kDigits[] = "0123456789abcdef";
        id += {kDigits[byte >> 4], kDigits[byte & 15]};
    }
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    const std::filesystem::path root = cache != nullptr  ? std::filesystem::path(cache)
                                       : home != nullptr ? std::filesystem::path(home) / ".cache"
                                                         : std::filesystem::temp_directory_path();
    return root / "raylab" / ("pipelines-" + id + ".bin");
}

void memoryBarrier(VkCommandBuffer commands, VkPipelineStageFlags stage, VkAccessFlags access) {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = access;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, stage, 0, 1, &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace

std::string versionText(uint32_t apiVersion) {
    return std::to_string(VK_API_VERSION_MAJOR(apiVersion)) + "." + std::to_string(VK_API_VERSION_MINOR(apiVersion)) + "." +
           std::to_string(VK_API_VERSION_PATCH(apiVersion));
}

std::vector<DeviceDescription> listDevices() {
    const std::scoped_lock lock(loaderMutex());
    VkInstance instance = makeInstance(false);
    std::vector<DeviceDescription> descriptions;
    for (VkPhysicalDevice device : physicalDevices(instance))
        descriptions.push_back(describe(device, static_cast<uint32_t>(descriptions.size())));
    vkDestroyInstance(instance, nullptr);
    return descriptions;
}

Device::Device(const DeviceOptions& options) {
    try {
        keepsPipelines_ = !options.graphics;
        {
            const std::scoped_lock lock(loaderMutex());
            createInstance(options);
            choosePhysicalDevice(options.selector);
            createDevice(options);
        }
        createCommandObjects();
        loadPipelineCache();
    } catch (...) {
        destroy();
        throw;
    }
}

Device::~Device() { destroy(); }

void Device::destroy() {
    if (device_ != VK_NULL_HANDLE) {
        // Nothing to be done about a failure here: whatever waits for results has waited in run().
        if (vkDeviceWaitIdle(device_) == VK_SUCCESS && pipelineCache_ && keepsPipelines_) savePipelineCache();
        pipelineCache_ = {};
        timestamps_ = {};
        fence_ = {};
        commandPool_ = {};
    }
    const std::scoped_lock lock(loaderMutex());
    if (device_ != VK_NULL_HANDLE) {
        vkDestroyDevice(device_, nullptr);
        forgetSimulatedLoss(device_);
        device_ = VK_NULL_HANDLE;
    }
    if (messenger_ != VK_NULL_HANDLE) destroyMessenger(instance_, messenger_);
    messenger_ = VK_NULL_HANDLE;
    if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
    instance_ = VK_NULL_HANDLE;
}

void Device::createInstance(const DeviceOptions& options) {
    instance_ = makeInstance(options.validation, options.instanceExtensions);
    debugUtils_ = options.validation;
    if (options.validation) messenger_ = makeMessenger(instance_, &validationMessages_);
}

void Device::choosePhysicalDevice(const std::string& selector) {
    const std::vector<VkPhysicalDevice> devices = physicalDevices(instance_);
    std::vector<DeviceDescription> descriptions;
    for (VkPhysicalDevice device : devices)
        descriptions.push_back(describe(device, static_cast<uint32_t>(descriptions.size())));
    const DeviceDescription* best = nullptr;
    for (const DeviceDescription& candidate : descriptions) {
        if (!candidate.unsuitable.empty() || (!selector.empty() && !matches(candidate, selector))) continue;
        if (best == nullptr || rank(candidate) < rank(*best)) best = &candidate;
    }
    if (best == nullptr) {
        const std::string what = selector.empty() ? "no suitable Vulkan device" : "no suitable Vulkan device matches '" + selector + "'";
        throw Error(what + ". This machine has:" + listText(descriptions), ExitCode::noDevice);
    }
    physical_ = devices[best->index];
    description_ = *best;
}

void Device::createDevice(const DeviceOptions& options) {
    VkPhysicalDeviceMaintenance3Properties maintenance{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &maintenance;
    vkGetPhysicalDeviceProperties2(physical_, &properties);
    properties_ = properties.properties;
    maxAllocationBytes_ = maintenance.maxMemoryAllocationSize;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);

    VkQueueFamilyProperties family{};
    VkQueueFlags wanted = VK_QUEUE_COMPUTE_BIT;
    if (options.graphics) wanted |= VK_QUEUE_GRAPHICS_BIT;
    const int32_t found = findQueueFamily(physical_, wanted, &family);
    if (found < 0) throw Error(description_.name + " has no queue that draws; choose another --device", ExitCode::noDevice);
    queueFamily_ = static_cast<uint32_t>(found);
    hasTimestamps_ = family.timestampValidBits > 0;
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = queueFamily_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    const RayTracingRequest request(description_.rayTracing);
    std::vector<const char*> extensions = request.extensions();
    extensions.insert(extensions.end(), options.deviceExtensions.begin(), options.deviceExtensions.end());
    info.pNext = request.features();
    info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
    vkGetDeviceQueue(device_, queueFamily_, 0, &queue_);
    if (description_.rayTracing.hasStructures())
        rayTracing_ = loadRayTracing(physical_, device_, description_.rayTracing);
}

void Device::createCommandObjects() {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT | VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = queueFamily_;
    VkCommandPool poolObject = VK_NULL_HANDLE;
    check(vkCreateCommandPool(device_, &pool, nullptr, &poolObject), "vkCreateCommandPool");
    commandPool_ = {device_, poolObject};

    VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocate.commandPool = poolObject;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device_, &allocate, &commands_), "vkAllocateCommandBuffers");

    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VkFence fenceObject = VK_NULL_HANDLE;
    check(vkCreateFence(device_, &fence, nullptr, &fenceObject), "vkCreateFence");
    fence_ = {device_, fenceObject};

    if (!hasTimestamps_) return;
    VkQueryPoolCreateInfo queries{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
    queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
    queries.queryCount = 2;
    VkQueryPool queryObject = VK_NULL_HANDLE;
    check(vkCreateQueryPool(device_, &queries, nullptr, &queryObject), "vkCreateQueryPool");
    timestamps_ = {device_, queryObject};
}

void Device::loadPipelineCache() {
    const std::filesystem::path path = pipelineCachePath(properties_);
    std::vector<std::byte> bytes;
    if (std::filesystem::is_regular_file(path)) bytes = readFile(path);
    VkPipelineCacheCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    info.initialDataSize = bytes.size();
    info.pInitialData = bytes.data();
    VkPipelineCache cache = VK_NULL_HANDLE;
    check(vkCreatePipelineCache(device_, &info, nullptr, &cache), "vkCreatePipelineCache");
    pipelineCache_ = {device_, cache};
}

void Device::savePipelineCache() const {
    size_t size = 0;
    if (vkGetPipelineCacheData(device_, pipelineCache_.get(), &size, nullptr) != VK_SUCCESS) return;
    std::vector<std::byte> bytes(size);
    if (vkGetPipelineCacheData(device_, pipelineCache_.get(), &size, bytes.data()) != VK_SUCCESS) return;
    try {
        writeFileAtomically(pipelineCachePath(properties_), std::span(bytes).first(size));
    } catch (const std::exception& error) {
        logInfo(std::string("the pipeline cache is not kept: ") + error.what());
    }
}

int32_t Device::findMemoryType(uint32_t typeBits, VkMemoryPropertyFlags wanted) const {
    for (uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
        if ((typeBits >> i & 1) != 0 && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted)
            return static_cast<int32_t>(i);
    return -1;
}

double Device::run(const char* label, const std::function<void(VkCommandBuffer)>& record) {
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
    setName(commands_, VK_OBJECT_TYPE_COMMAND_BUFFER, label);
    if (hasTimestamps_) {
        vkCmdResetQueryPool(commands_, timestamps_.get(), 0, 2);
        vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, timestamps_.get(), 0);
    }
    // Submissions are ordered by the fence; these barriers order their memory, for the device and for the host.
    memoryBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT);
    record(commands_);
    memoryBarrier(commands_, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
    if (hasTimestamps_) vkCmdWriteTimestamp(commands_, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, timestamps_.get(), 1);
    check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");

    VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    info.commandBufferCount = 1;
    info.pCommandBuffers = &commands_;
    const VkFence fence = fence_.get();
    const auto start = std::chrono::steady_clock::now();
    submit(*this, label, info, fence);
    check(vkWaitForFences(device_, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    check(vkResetFences(device_, 1, &fence), "vkResetFences");
    if (!hasTimestamps_) return wall.count();
    std::array<uint64_t, 2> ticks{};
    check(vkGetQueryPoolResults(device_, timestamps_.get(), 0, 2, sizeof(ticks), ticks.data(), sizeof(uint64_t),
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
          "vkGetQueryPoolResults");
    return static_cast<double>(ticks[1] - ticks[0]) * static_cast<double>(limits().timestampPeriod) * 1e-9;
}

void Device::setObjectName(uint64_t object, VkObjectType type, const std::string& name) const {
    if (!debugUtils_) return;
    const auto function =
        reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(vkGetDeviceProcAddr(device_, "vkSetDebugUtilsObjectNameEXT"));
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = object;
    info.pObjectName = name.c_str();
    const std::scoped_lock lock(loaderMutex());
    check(function(device_, &info), "vkSetDebugUtilsObjectNameEXT");
}

}  // namespace raylab
