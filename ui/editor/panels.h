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
};

std::span<const Panel> panelTable();

void drawViewportPanel(EditorContext& context);
void drawScenePanel(EditorContext& context);
void drawInspectorPanel(EditorContext& context);
void drawRenderPanel(EditorContext& context);
void drawComparePanel(EditorContext& context);
void drawKernelPanel(EditorContext& context);
void drawLogPanel(EditorContext& context);
/// The list of keys over everything else, while context.showKeys.
void drawKeysOverlay(EditorContext& context);

}  // namespace raylab
