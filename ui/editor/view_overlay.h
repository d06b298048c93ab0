#pragma once

#include "ui/editor/context.h"

namespace raylab {

/// Draws the grid, and the silhouette of what is selected (its box while that is not known), over the viewport's picture into the current ImGui window.
void drawViewOverlay(EditorContext& context);

}  // namespace raylab
