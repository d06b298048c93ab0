#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace raylab {

std::string vulkanResultName(VkResult result);

/// Throws Error unless `result` is VK_SUCCESS: out of memory as the user's problem, anything else as internal. Every
/// Vulkan call that returns a result goes through here, in every build.
void check(VkResult result, const char* what);

}  // namespace raylab
