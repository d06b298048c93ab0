#pragma once

#include "ui/editor/context.h"

namespace raylab {

/// Draws the handles of what is selected over the picture and lets the pointer drag them: instances, and the position
/// and direction of lights. Ctrl snaps. To be called after the viewport's invisible button. True while the pointer is
/// on a handle or drags one, and then nothing else of the viewport should take it.
bool drawGizmo(EditorContext& context);

}  // namespace raylab
