#pragma once

#include "engine/scene/bounds.h"
#include "engine/scene/scene.h"

namespace raylab {

// Movements of a camera. Its target is the pivot that it orbits, its up the axis that the horizon is level to.

/// Turns the view about the camera, radians to the right and upwards; never over the zenith.
void lookAround(Camera& camera, float right, float up);

/// Turns the camera about its target, as if the scene were turned to the right and downwards by so many radians.
void orbit(Camera& camera, float right, float down);

/// Multiplies the distance to the target.
void dolly(Camera& camera, float factor);

/// Moves camera and target by scene units to the right, upwards in the picture, and ahead.
void fly(Camera& camera, const glm::vec3& rightUpAhead);

/// Moves the target, and turns the view to it.
void setPivot(Camera& camera, const glm::vec3& pivot);

/// Keeps the direction of view and shows all of the box, in the narrower of the two fields of view.
void frameBox(Camera& camera, const Bounds& box, float aspect);

/// Where the camera sees a point: x to the right and y downwards from the upper left, 0 to 1 within the picture, z the
/// distance along the axis of view (not positive: behind the camera).
glm::vec3 projectPoint(const Camera& camera, float aspect, const glm::vec3& point);

/// An orthonormal frame: to the right, upwards in the picture, ahead.
struct CameraAxes {
    glm::vec3 right, up, ahead;
};
CameraAxes cameraAxes(const Camera& camera);

}  // namespace raylab
