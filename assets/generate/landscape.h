#pragma once

#include "assets/generate/mesh_tools.h"

namespace raylab::assets {

/// Rolling ground about the building out to 270 m, level near it and just below its floors.
Geometry hills();

/// Bell tower, foot at y = 0 and 12.4 m tall: masonry and roof apart. The arches of its belfry are the court's own,
/// placed by the caller at kBelfryFloor on each side, half a kBay from the axis.
Geometry towerWalls();
Geometry towerRoof();
constexpr float kBelfryFloor = 7.2f;

}  // namespace raylab::assets
