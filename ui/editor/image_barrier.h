#pragma once

#include <vulkan/vulkan.h>

namespace raylab {

/// What comes before is done before what comes after, and the image, of one mip and colours, is in the layout `to`.
void changeLayout(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to, VkAccessFlags before,
                  VkAccessFlags after);

}  // namespace raylab
