#pragma once

#include <optional>

#include "ui/editor/context.h"
#include "ui/editor/view_actions.h"

/// What menus and keys do to what is selected.
namespace raylab {

bool hasSelectedInstances(const EditorContext& context);
bool hasSelection(const EditorContext& context);

void duplicateSelection(EditorContext& context);
void deleteSelection(EditorContext& context);
void hideSelection(EditorContext& context);
void isolateSelection(EditorContext& context);
void showAllAgain(EditorContext& context);
void selectAll(EditorContext& context);
void selectNothing(EditorContext& context);

/// Entries for the selected instances.
void drawSelectionMenu(EditorContext& context);

/// Entries for what can be added; it comes to the view's pivot.
void drawAddMenu(EditorContext& context);

/// Of a material that is being dropped onto the item drawn last, within BeginDragDropTarget().
std::optional<uint32_t> draggedMaterial();

}  // namespace raylab
