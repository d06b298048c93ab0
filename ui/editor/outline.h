#pragma once

#include <cstdint>
#include <vector>

#include "ui/editor/context.h"
#include "ui/editor/hit_map.h"

namespace raylab {

/// Texels of a line around all pixels whose instance is selected (a mask over the rendered scene's instances), as wide
/// as `radius` pixels, just outside of them; the rest is transparent. `color` as ImGui has it.
std::vector<uint32_t> outlineTexels(const HitMap& map, const std::vector<bool>& selected, int radius, uint32_t color);

/// Draws the silhouette of what is selected over the viewport's picture. False where the picture does not know what
/// lies behind its pixels.
bool drawOutline(EditorContext& context);

}  // namespace raylab
