#pragma once

#include "assets/generate/builder.h"

namespace raylab::assets {

constexpr float kCourtHalfX = 6.25f;  ///< five bays across
constexpr float kCourtHalfZ = 10.0f;  ///< eight bays deep

/// Meshes of the building that others may place again.
struct BuildingMeshes {
    uint32_t archWall;
    uint32_t archStones;
    uint32_t pier;
};

/// Paving, arcades with covered walks at -X, -Z and +Z, and a free-standing screen of arches at +X, through which the
/// sun comes.
BuildingMeshes addBuilding(Builder& builder);

}  // namespace raylab::assets
