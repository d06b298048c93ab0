#pragma once

#include <string>

#include "ui/editor/context.h"

namespace raylab {

// What keys and menus do with the view.

/// The next tracer that the device runs, after the one of the settings.
void nextTracer(EditorContext& context);
void focusSelection(EditorContext& context);
void showAll(EditorContext& context);
/// Through the clipboard, as JSON.
void copyCamera(EditorContext& context);
void pasteCamera(EditorContext& context);
/// Writes the picture of the viewport to raylab-SCENE-N.png in the current folder, in the background.
void saveScreenshot(EditorContext& context);
/// Adds the view to the scene's cameras.
void saveView(EditorContext& context);
/// Renders the view at the settings' size and samples to raylab-SCENE-N.EXTENSION (.png or .exr), in the background.
void renderToFile(EditorContext& context, const std::string& extension);

}  // namespace raylab
