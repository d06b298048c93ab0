#include "engine/gpu/submit.h"

#include "engine/gpu/check.h"
#include "engine/gpu/simulated_failure.h"

namespace raylab {

void submit(const Device& device, const char* label, const VkSubmitInfo& info, VkFence fence) {
    VkResult result = takeSimulatedFailure(device.get(), label);
    if (result == VK_SUCCESS) result = vkQueueSubmit(device.queue(), 1, &info, fence);
    check(result, (std::string("vkQueueSubmit of ") + label).c_str());
}

}  // namespace raylab
