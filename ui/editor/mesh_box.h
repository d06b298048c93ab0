#pragma once

#include "engine/scene/bounds.h"
#include "engine/scene/scene.h"

namespace raylab {

/// The box of a mesh in its own space; kept, for what is drawn over the picture asks each frame. The reference holds
/// until the next call.
const Bounds& meshBox(const Scene& scene, uint32_t mesh);

}  // namespace raylab
