#pragma once

#include "ui/editor/context.h"

/// The parts of the inspector, one for each kind of thing that can be selected.
namespace raylab {

void inspectInstances(EditorContext& context);
void inspectMaterial(EditorContext& context, uint32_t material);
void inspectLight(EditorContext& context, uint32_t light);
void inspectCamera(EditorContext& context, uint32_t camera);
/// The viewport's own view, and sun, sky and radiance map.
void inspectView(EditorContext& context);
void inspectSurroundings(EditorContext& context);

/// A dim heading over a part.
void inspectorHeading(const char* text);

/// A text field for a name; true when a new one was entered.
bool editName(std::string& name);

/// Shown for the widget drawn last.
void inspectorTip(const char* text);

}  // namespace raylab
