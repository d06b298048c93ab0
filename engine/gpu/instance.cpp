#include "engine/gpu/instance.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/gpu/check.h"

namespace raylab {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool hasLayer(const char* name) {
    uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
    return std::any_of(layers.begin(), layers.end(),
                       [&](const VkLayerProperties& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                         VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<std::atomic<uint32_t>*>(user)->fetch_add(1);
    const std::string text = std::string("validation: ") + data->pMessage;
    if (severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT)
        logError(text);
    else
        logWarning(text);
    return VK_FALSE;
}

template <class Function>
Function instanceFunction(VkInstance instance, const char* name) {
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

const char* kindName(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return "discrete";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return "integrated";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return "virtual";
        case VK_PHYSICAL_DEVICE_TYPE_CPU: return "cpu";
        default: return "other";
    }
}

}  // namespace

VkInstance makeInstance(bool validation, std::span<const char* const> extensions) {
    uint32_t version = VK_API_VERSION_1_0;
    check(vkEnumerateInstanceVersion(&version), "vkEnumerateInstanceVersion");
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "raylab";
    application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;

    const std::array enabled = {VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
    features.enabledValidationFeatureCount = static_cast<uint32_t>(enabled.size());
    features.pEnabledValidationFeatures = enabled.data();
    std::vector<const char*> allExtensions(extensions.begin(), extensions.end());
    if (validation) {
        if (!hasLayer(kValidationLayer))
            throw Error(std::string(kValidationLayer) + " is not installed; install vulkan-validationlayers or leave out --validation");
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &kValidationLayer;
        allExtensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }
    info.enabledExtensionCount = static_cast<uint32_t>(allExtensions.size());
    info.ppEnabledExtensionNames = allExtensions.data();
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result != VK_SUCCESS)
        throw Error("no Vulkan driver works here (" + vulkanResultName(result) +
                        "); install mesa-vulkan-drivers or the GPU's own driver",
                    ExitCode::noDevice);
    return instance;
}

VkDebugUtilsMessengerEXT makeMessenger(VkInstance instance, std::atomic<uint32_t>* count) {
    VkDebugUtilsMessengerCreateInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = onMessage;
    info.pUserData = count;
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    const auto create = instanceFunction<PFN_vkCreateDebugUtilsMessengerEXT>(instance, "vkCreateDebugUtilsMessengerEXT");
    check(create(instance, &info, nullptr, &messenger), "vkCreateDebugUtilsMessengerEXT");
    return messenger;
}

void destroyMessenger(VkInstance instance, VkDebugUtilsMessengerEXT messenger) {
    instanceFunction<PFN_vkDestroyDebugUtilsMessengerEXT>(instance, "vkDestroyDebugUtilsMessengerEXT")(instance, messenger,
                                                                                                       nullptr);
}

std::mutex& loaderMutex() {
    static std::mutex mutex;
    return mutex;
}

std::vector<VkPhysicalDevice> physicalDevices(VkInstance instance) {
    uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(instance, &count, devices.data()), "vkEnumeratePhysicalDevices");
    return devices;
}

int32_t findQueueFamily(VkPhysicalDevice device, VkQueueFlags wanted, VkQueueFamilyProperties* properties) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & wanted) != wanted) continue;
        if (properties != nullptr) *properties = families[i];
        return static_cast<int32_t>(i);
    }
    return -1;
}

DeviceDescription describe(VkPhysicalDevice device, uint32_t index) {
    VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    VkPhysicalDeviceProperties base{};
    vkGetPhysicalDeviceProperties(device, &base);
    if (base.apiVersion >= VK_API_VERSION_1_2) properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &properties);
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(device, &memory);

    DeviceDescription description;
    description.index = index;
    description.name = base.deviceName;
    description.driver = std::string(driver.driverName) + " " + driver.driverInfo;
    description.kind = kindName(base.deviceType);
    description.apiVersion = base.apiVersion;
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0)
            description.memoryBytes = std::max<uint64_t>(description.memoryBytes, memory.memoryHeaps[i].size);
    description.maxStorageBufferRange = base.limits.maxStorageBufferRange;
    description.maxTexelBufferElements = base.limits.maxTexelBufferElements;
    if (base.apiVersion < VK_API_VERSION_1_2)
        description.unsuitable = "offers Vulkan " + versionText(base.apiVersion) + ", raylab needs 1.2";
    else if (findQueueFamily(device, VK_QUEUE_COMPUTE_BIT, nullptr) < 0)
        description.unsuitable = "has no queue that computes";
    if (base.apiVersion >= VK_API_VERSION_1_2)
        description.rayTracing = rayTracingOffer(device);
    else
        description.rayTracing = {"Vulkan 1.2", "Vulkan 1.2"};
    return description;
}

}  // namespace raylab
