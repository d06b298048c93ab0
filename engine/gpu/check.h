#pragma once

#include <vulkan/vulkan.h>

#include <string>

#include "engine/core/error.h"

namespace raylab {

std::string vulkanResultName(VkResult result);

/// The driver gave up on a device (VK_ERROR_DEVICE_LOST): what was on it is gone, and another one may work. Unless caught
/// it ends the program as where there is no suitable device.
class DeviceLost : public Error {
public:
    explicit DeviceLost(const std::string& message) : Error(message, ExitCode::noDevice) {}
};

/// Throws Error unless `result` is VK_SUCCESS: out of memory as the user's problem, a lost device as DeviceLost,
/// anything else as internal. Every Vulkan call that returns a result goes through here, in every build.
void check(VkResult result, const char* what);

}  // namespace raylab
