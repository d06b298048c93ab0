#pragma once

#include <string>

#include "engine/scene/scene.h"
#include "shaders/shared/frame.h"

namespace raylab {

/// The camera that a text names: its number or name in the scene, or "px,py,pz,tx,ty,tz,fov" (position, target, vertical
/// field of view in degrees, y up). Number 0 of a scene without cameras is a view of the whole. Throws Error that lists
/// the scene's cameras where none fits.
Camera chooseCamera(const Scene& scene, const std::string& text);

/// "px,py,pz,tx,ty,tz,fov", as chooseCamera() reads it, for a camera whose up is +y.
std::string cameraNumbers(const Camera& camera);

/// The fields of the camera and of the image's size (methods.md, "Common").
void writeCamera(const Camera& camera, uint32_t width, uint32_t height, shared::FrameParams& frame);

/// The camera at the end of its motion, in the same way; `shutter`: part of the motion that is seen, from its start on.
void writeCameraEnd(const Camera& camera, double shutter, shared::FrameParams& frame);

/// The thin lens: `lensRadius` in scene units, focal length over twice the f-number (0: a pinhole); what lies
/// `focusDistance` along the axis is sharp. 0: where the camera's target is.
void writeLens(const Camera& camera, double lensRadius, double focusDistance, shared::FrameParams& frame);

}  // namespace raylab
