#pragma once

#include "assets/generate/mesh_tools.h"

namespace raylab::assets {

/// A plant: opaque wood and cards that carry a sprig texture (uv (0.5, 1) at the stem).
struct Plant {
    Geometry wood;
    Geometry leaves;
    Geometry fruit;  ///< may be empty
};

/// Round-headed citrus tree rising from y = 0, about 1.7 m tall; the pot is not part of it.
Plant citrusTree(uint32_t seed);

/// Spindle of upright sprigs, 1 m tall and to be scaled: narrow cypress.
Plant cypress(uint32_t seed);

/// Climber that rises along +Y from the origin, follows the bay's arch towards +X and hangs over it.
Plant climber(uint32_t seed);

}  // namespace raylab::assets
