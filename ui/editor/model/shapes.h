#pragma once

#include <array>

#include "ui/editor/model/document.h"

namespace raylab::editor {

/// What can be added; all are 2 across and stand around the origin of their own space.
enum class Shape { plane, box, sphere, ellipsoid, cylinder, cone, hyperboloid, paraboloid };

inline constexpr std::array kShapes = {Shape::plane,    Shape::box,  Shape::sphere,      Shape::ellipsoid,
                                       Shape::cylinder, Shape::cone, Shape::hyperboloid, Shape::paraboloid};

const char* shapeName(Shape shape);

/// Plane, box and sphere are triangles with texture coordinates, the others quadrics.
Mesh makeShape(Shape shape);

/// Adds one at a point of the world, `radius` from its middle to its sides; it wears the selected material, or else a
/// grey one of its own. It is selected. Quadrics stand upright (their z is the world's y).
Edit addShape(Shape shape, glm::vec3 position, float radius);

}  // namespace raylab::editor
