#pragma once

#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"

/// What the tests of Whitted's ray tracer share.
namespace raylab::support {

inline Material phongMaterial(const PhongMaterial& phong) {
    Material material = lambert(0.8f);
    material.phong = phong;
    return material;
}

/// No branch ends early; the depth is that of mirrored and refracted rays.
inline RenderSettings whitted(int64_t depth = 0) {
    RenderSettings settings = smallImage(8, 2, depth);
    settings.integrator = "whitted";
    settings.threshold = 0.0;
    settings.environment = "none";
    return settings;
}

}  // namespace raylab::support
