#pragma once

#include "assets/generate/mesh_tools.h"

namespace raylab::assets {

/// A winged figure in wind-blown drapery, headless and armless as antique marbles come down to us, alighting on a small
/// rock: more than 400,000 triangles. Metres; stands on y = 0 about the origin, faces +Z, 3.5 m to the
/// wing tips.
Geometry makeStatue();

}  // namespace raylab::assets
