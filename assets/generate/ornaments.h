#pragma once

#include "assets/generate/mesh_tools.h"

namespace raylab::assets {

// Things on tables, floors and walls. Each stands on y = 0 unless told otherwise.

/// Terracotta pot with a rolled rim, its earth separately.
Geometry plantPot();
Geometry potEarth();
/// Tall two-handled jar.
Geometry amphora();
/// Blown vase: one closed surface, outside and inside, so that it refracts as a wall of glass.
Geometry glassVase();
/// Armillary sphere on a baluster stand: rings, axis and a ball at the centre. Height about 0.78.
Geometry armillary();
/// Small ring for a ball to rest on.
Geometry ballRest(float ballRadius);
/// Hanging lantern: origin at the hook, metal and light separately.
Geometry lanternMetal();
Geometry lanternLight();

}  // namespace raylab::assets
