#pragma once

#include "ui/editor/context.h"

namespace raylab {

/// Draws the grid, and the box around what is selected, over the viewport's picture into the current ImGui window.
void drawViewOverlay(EditorContext& context);

}  // namespace raylab
