#pragma once

#include <cstddef>

#include "engine/scene/scene.h"

namespace raylab {

struct Bounds {
    glm::vec3 lo{0.0f};
    glm::vec3 hi{0.0f};
};

/// World-space box of all instances' vertices, exact (not the box of transformed boxes), and of their quadrics' boxes.
/// Zero for a scene without instances.
Bounds sceneBounds(const Scene& scene);

/// A three-quarter view from slightly above that shows the whole scene at a vertical field of view of 45 degrees, in a
/// square image or a wider one; Y is up.
Camera defaultCamera(const Scene& scene);

struct PrimitiveCount {
    size_t stored = 0;     ///< each mesh once
    size_t instanced = 0;  ///< each mesh as often as it is placed
};

PrimitiveCount triangleCount(const Scene& scene);
PrimitiveCount quadricCount(const Scene& scene);

}  // namespace raylab
