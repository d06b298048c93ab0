#pragma once

#include "ui/editor/context.h"

namespace raylab {

/// Draws the menu bar, the panes with their panels, and the status line, filling ImGui's display. Panes are divided by
/// lines that one drags; where they stand is kept in the config.
void drawLayout(EditorContext& context);

}  // namespace raylab
