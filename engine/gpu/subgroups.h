#pragma once

#include <vulkan/vulkan.h>

#include <string>

namespace raylab {

class Device;

/// Throws Error with ExitCode::noDevice where lanes of a subgroup cannot `operation` on the device: "`user`: DEVICE has no
/// subgroup `name`; `remedy`".
void requireSubgroups(const Device& device, VkSubgroupFeatureFlagBits operation, const std::string& user,
                      const std::string& name, const std::string& remedy);

}  // namespace raylab
