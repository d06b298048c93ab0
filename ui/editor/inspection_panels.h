#pragma once

#include "ui/editor/context.h"

namespace raylab {

// Panels that look into the trees and what rays do in them.

void drawBvhPanel(EditorContext& context);
void drawNodesPanel(EditorContext& context);
void drawRayPanel(EditorContext& context);
void drawHeatPanel(EditorContext& context);

}  // namespace raylab
