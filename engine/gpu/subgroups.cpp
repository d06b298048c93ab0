#include "engine/gpu/subgroups.h"

#include "engine/core/error.h"
#include "engine/gpu/device.h"

namespace raylab {

void requireSubgroups(const Device& device, VkSubgroupFeatureFlagBits operation, const std::string& user,
                      const std::string& name, const std::string& remedy) {
    VkPhysicalDeviceSubgroupProperties subgroups{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    properties.pNext = &subgroups;
    vkGetPhysicalDeviceProperties2(device.physical(), &properties);
    if ((subgroups.supportedOperations & static_cast<VkSubgroupFeatureFlags>(operation)) == 0)
        throw Error(user + ": " + device.description().name + " has no subgroup " + name + "; " + remedy,
                    ExitCode::noDevice);
}

}  // namespace raylab
