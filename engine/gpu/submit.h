#pragma once

#include "engine/gpu/device.h"

namespace raylab {

/// Submits commands to the device's queue. `label`: what they are, also for tests that ask for failures
/// (simulated_failure.h). Throws DeviceLost, and Error where memory is short.
void submit(const Device& device, const char* label, const VkSubmitInfo& info, VkFence fence);

}  // namespace raylab
