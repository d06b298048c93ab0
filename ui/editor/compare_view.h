#pragma once

#include "ui/editor/context.h"

namespace raylab {

/// Draws A and B, or how they differ, into the viewport: `imageA` shows A's picture and fills context.view. For a
/// comparison that is on.
void drawComparison(EditorContext& context, const UiImagePtr& imageA);

/// The line between A and B is dragged, and what A and B are is said above them. True while the pointer is on the line.
/// To be called after the viewport's own item.
bool drawComparisonHandles(EditorContext& context);

}  // namespace raylab
