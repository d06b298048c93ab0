#pragma once

#include <vulkan/vulkan.h>

#include <string>
#include <string_view>

namespace raylab {

/// Failures of drivers that tests ask for: at which submission of the process, and what Vulkan is to answer. A comma
/// separates one from the next: WHAT@LABEL:N is the N-th submission labelled LABEL (submit.h) after the failures
/// of that label which stand before it; WHAT is device-lost or out-of-memory. Throws Error where a text is none of
/// that.
void simulateFailures(std::string_view text);

/// What a submission is to be answered with instead of being made: VK_SUCCESS where it is to be made. Counts it. A
/// device that was lost so stays lost. The first call of the process reads the failures in the environment variable
/// RAYLAB_SIMULATE.
VkResult takeSimulatedFailure(VkDevice device, std::string_view label);

/// The device is destroyed: another one may get its handle.
void forgetSimulatedLoss(VkDevice device);

}  // namespace raylab
