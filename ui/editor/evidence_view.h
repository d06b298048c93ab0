#pragma once

#include <string>

#include "engine/measure/stability/evidence.h"
#include "ui/editor/context.h"

namespace raylab {

class LinePainter;

/// Opens the scene of a failure in the viewport, by its camera and settings, with what is wrong marked. Asks before
/// edits are lost.
void showEvidence(EditorContext& context, const std::string& title, const stability::Evidence& evidence);

/// Whether the viewport shows the scene of showEvidence().
bool isShowingEvidence(EditorContext& context);

/// Its wrong rays and, while the camera is as it was, its wrong pixels; nothing where another scene is open.
void drawEvidence(EditorContext& context, const LinePainter& painter);

}  // namespace raylab
