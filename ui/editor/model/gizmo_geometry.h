#pragma once

#include <optional>

#include "ui/editor/model/gizmo.h"

/// What drawing and dragging a gizmo have in common.
namespace raylab::editor {

/// Whether an arm is long enough in the image to be dragged along: it is not within 8 degrees of the line of sight.
bool isArmVisible(const GizmoView& view, const GizmoPose& pose, int axis);

/// Whether a plane through the origin is not seen from its edge: by more than 8 degrees.
bool isPlaneVisible(const GizmoView& view, const GizmoPose& pose, const glm::dvec3& normal);

/// Along the line origin + t direction (unit): the t nearest to the ray. Nothing where they are parallel, or nearest
/// behind the eye.
std::optional<double> nearestOnLine(const ViewRay& ray, const glm::dvec3& origin, const glm::dvec3& direction);

/// Where the ray meets the plane. Nothing where it does not, or behind the eye.
std::optional<glm::dvec3> hitPlane(const ViewRay& ray, const glm::dvec3& origin, const glm::dvec3& normal);

}  // namespace raylab::editor
