#pragma once

#include <span>
#include <string_view>

#include "ui/editor/context.h"

namespace raylab {

enum class Pane { left, right, bottom, centre };

/// A panel of the editor: one file in panels/, one row in panels.cpp.
struct Panel {
    std::string_view name;
    void (*draw)(EditorContext& context);  ///< into the current ImGui window
    Pane pane;
    float leastHeight = 0.0f;  ///< that its pane gets while it is in front, at a scale of 1
};

std::span<const Panel> panelTable();

void drawViewportPanel(EditorContext& context);
void drawScenePanel(EditorContext& context);
void drawInspectorPanel(EditorContext& context);
void drawRenderPanel(EditorContext& context);
void drawComparePanel(EditorContext& context);
void drawKernelPanel(EditorContext& context);
void drawLogPanel(EditorContext& context);
void drawChartPanel(EditorContext& context);
void drawStabilityPanel(EditorContext& context);
void drawAdvicePanel(EditorContext& context);
/// The list of keys over everything else, while context.showKeys.
void drawKeysOverlay(EditorContext& context);

}  // namespace raylab
