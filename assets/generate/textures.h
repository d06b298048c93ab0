#pragma once

#include "assets/generate/surface_maps.h"

namespace raylab::assets {

// Each tiles seamlessly. The metres that one repeat covers are the constant beside it.

constexpr float kPavingMetres = 2.5f;
SurfaceMaps paintPaving();  ///< cream octagons with dark red insets, worn and slightly polished

constexpr float kPlasterMetres = 2.5f;
SurfaceMaps paintPlaster();  ///< warm, trowelled, weathered

constexpr float kLimestoneMetres = 1.25f;
SurfaceMaps paintLimestone();  ///< fine-grained with pits

constexpr float kTerracottaMetres = 1.2f;
SurfaceMaps paintTerracottaFloor();  ///< square tiles laid diagonally

constexpr float kRoofMetres = 3.0f;
SurfaceMaps paintRoofTile();  ///< fired clay with lichen; one tile shows a small part of it

constexpr float kWoodMetres = 1.0f;
SurfaceMaps paintWood();  ///< grain along u

constexpr float kMarbleMetres = 1.6f;
SurfaceMaps paintMarble();  ///< white with soft grey veins; colour only

constexpr float kWaterMetres = 1.5f;
SurfaceMaps paintWater();  ///< ripples: the normal map matters

// Sprigs with alpha, the stem rising from the middle of the lower edge. Not seamless.

SurfaceMaps paintCitrusSprig();
SurfaceMaps paintBougainvilleaSprig();  ///< magenta bracts among small leaves
SurfaceMaps paintCypressSprig();

}  // namespace raylab::assets
