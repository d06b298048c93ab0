#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/gpu/device.h"
#include "engine/gpu/pipeline.h"
#include "engine/scene/scene.h"
#include "tests/shaders/bsdf_push.h"

namespace raylab::support {

/// A floor (y = 0, tangents along +X) of the material.
Scene floorOf(const Material& material);

/// tests/shaders/bsdf.comp with all needs, compiled once.
class BsdfKernel {
public:
    explicit BsdfKernel(Device& device);

    /// The kernel's results in order, of floorOf(material).
    std::vector<glm::vec4> draw(const Material& material, const shared::BsdfPush& push) const;

private:
    Device& device_;
    KernelLayout layout_;
    Kernel kernel_;
};

}  // namespace raylab::support
