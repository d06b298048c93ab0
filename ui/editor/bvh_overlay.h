#pragma once

#include <optional>

#include "engine/scene/bounds.h"
#include "ui/editor/bvh_state.h"

namespace raylab {

/// A panel that shows the trees says so in each frame: they are built while someone looks at them.
void lookAtTrees(EditorContext& context);

/// Keeps the trees, the boxes that are drawn and the ray of the stepper up with scene, settings and view; to be called
/// once a frame. Nothing is waited for.
void keepTrees(EditorContext& context);

/// Draws boxes, the selected node and the stepper's ray over the viewport's picture, into the current ImGui window.
void drawBvhOverlay(EditorContext& context);

/// A click at a point of the picture, (0, 0) at its upper left: chooses a ray, or selects a leaf where boxes are shown.
/// False where it is none of ours.
bool takeBvhClick(EditorContext& context, float x, float y);

/// Around the selected node, while nodes are shown.
std::optional<Bounds> selectedNodeBox(EditorContext& context);

/// The ray through a point of the picture.
WalkRay rayThroughView(const EditorContext& context, float x, float y);

/// Colour of a node's box by what the panel chose.
glm::vec3 boxColor(const BvhState& state, const TreeInspection& trees, const TreeNode& at);

}  // namespace raylab
