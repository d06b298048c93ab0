#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <span>
#include <vector>

#include "engine/gpu/device.h"

namespace raylab {

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
