#pragma once

#include "ui/editor/model/document.h"

/// Edits of the scene's cameras. Indices count Scene::cameras and exist. The view that one flies about with is the
/// viewport's own until it is saved as one of these.
namespace raylab::editor {

/// The new camera is selected.
Edit addCamera(Camera camera);

/// `what` names the part that changes. Throws Error on apply for a camera that looks nowhere (position and target are
/// one point, or not finite) or whose field of view is not within 0.1 and 179 degrees.
Edit setCamera(uint32_t index, Camera camera, const std::string& what, std::string mergeKey = {});
Edit deleteCamera(uint32_t index);

/// Distance from the target.
float cameraRadius(const Camera& camera);
/// At another distance from the target, on the same line of view; `radius` is positive.
Camera atRadius(Camera camera, float radius);
/// `steps` steps of a length away from the target, as one changes a view by radius and step; it stops short of the
/// target.
Camera movedAlongView(Camera camera, float stepLength, int steps);

/// JSON for the clipboard, and back. Throws Error for a text of something else.
std::string cameraText(const Camera& camera);
Camera parseCamera(const std::string& text);

/// What `--camera` takes: position, target, vertical degrees; with all digits.
std::string cameraArgument(const Camera& camera);

}  // namespace raylab::editor
