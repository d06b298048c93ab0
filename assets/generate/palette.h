#pragma once

#include "assets/generate/scene_tools.h"

namespace raylab::assets {

/// The courtyard's materials: indices for addMesh().
struct Palette {
    uint32_t paving = 0;
    uint32_t plaster = 0;
    uint32_t limestone = 0;
    uint32_t terracottaFloor = 0;
    uint32_t roofTile = 0;
    uint32_t wood = 0;
    uint32_t marble = 0;
    uint32_t water = 0;
    uint32_t terracotta = 0;
    uint32_t earth = 0;
    uint32_t bark = 0;
    uint32_t citrusLeaf = 0;
    uint32_t bougainvillea = 0;
    uint32_t cypressLeaf = 0;
    uint32_t orange = 0;
    uint32_t hills = 0;
    uint32_t clearGlass = 0;
    uint32_t tintedGlass = 0;
    uint32_t gold = 0;
    uint32_t copper = 0;
    uint32_t iron = 0;
    uint32_t lanternLight = 0;
};

/// Paints the textures (in parallel) and adds them with their materials.
Palette addPalette(Scene& scene);

}  // namespace raylab::assets
