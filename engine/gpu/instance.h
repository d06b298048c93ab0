#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <mutex>
#include <span>
#include <vector>

#include "engine/gpu/device.h"

namespace raylab {

/// To be held by who makes, looks through or destroys instances and devices, makes a swapchain or names an object.
/// Vulkan lets threads do all of these at once, with instances of their own. But the last two make its loader walk all
/// instances and their drivers without a lock (loader_get_icd_and_device), while since 1.3.274 looking through the devices of any
/// instance unloads drivers that have none: in the loader of Debian 13 the walker then meets freed memory.
std::mutex& loaderMutex();

/// A Vulkan 1.2 instance with `extensions`, and validation layers where asked. Throws Error (exit code 3) where there is
/// no Vulkan, and Error where validation is asked for and its layer is not installed.
VkInstance makeInstance(bool validation, std::span<const char* const> extensions = {});

/// Routes validation messages to the log and counts them in `count`, which must outlive the messenger.
VkDebugUtilsMessengerEXT makeMessenger(VkInstance instance, std::atomic<uint32_t>* count);
void destroyMessenger(VkInstance instance, VkDebugUtilsMessengerEXT messenger);

std::vector<VkPhysicalDevice> physicalDevices(VkInstance instance);
DeviceDescription describe(VkPhysicalDevice device, uint32_t index);

/// First queue family that can do all of `wanted`, -1 where there is none.
int32_t findQueueFamily(VkPhysicalDevice device, VkQueueFlags wanted, VkQueueFamilyProperties* properties);

}  // namespace raylab
