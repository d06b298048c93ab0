#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/scene/scene.h"

namespace raylab::support {

/// What tests/shaders/samples.comp is to draw, and from which numbers.
struct DrawConfig {
    uint32_t routine = 0;  ///< shared::kRoutine...
    uint32_t sampler = 1;  ///< shared::kSampler...; independent numbers
    uint32_t filter = 0;   ///< shared::kFilter...
    float filterRadius = 1.0f;
    uint32_t count = 1u << 20;
    uint32_t samplesPerPixel = 1;  ///< drawn one after another
    uint32_t pixelsPerRow = 1024;
    uint32_t sampleCount = 1;  ///< that the stratified sampler spreads its strata over
    uint32_t firstSample = 0;
    uint32_t seed = 7;
    glm::vec3 wo{0.0f, 0.0f, 1.0f};
    float alpha = 0.5f;
    const Environment* environment = nullptr;
};

/// The kernel's results in order.
std::vector<glm::vec4> drawSamples(Device& device, const DrawConfig& config);

}  // namespace raylab::support
