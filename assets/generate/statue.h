#pragma once

#include "assets/generate/mesh_tools.h"

namespace raylab::assets {

/// A winged figure in wind-blown drapery, headless and armless as antique marbles come down to us, alighting on a small
/// rock: more than 400,000 triangles. Metres; stands on y = 0 about the origin, faces +Z, about kStatueHeight tall.
Geometry makeStatue();
constexpr float kStatueHeight = 2.9f;

}  // namespace raylab::assets
