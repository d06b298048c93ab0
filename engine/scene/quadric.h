#pragma once

#include <array>
#include <string_view>

#include "engine/scene/bounds.h"
#include "engine/scene/scene.h"

namespace raylab {

/// In the order of QuadricKind: as files spell them.
inline constexpr std::array<std::string_view, 5> kQuadricKindNames = {"ellipsoid", "cylinder", "cone", "hyperboloid",
                                                                      "paraboloid"};

/// A kind as X^2 + Y^2 + zz Z^2 + z Z + constant = 0, with coordinates over the radii; negative inside.
struct QuadricForm {
    float zz = 0.0f;
    float z = 0.0f;
    float constant = 0.0f;
};

QuadricForm quadricForm(QuadricKind kind);

/// The box of what the clip planes leave, in the quadric's own space; lo > hi where they leave nothing.
Bounds quadricBounds(const Quadric& quadric);

/// The box of that box's corners under `matrix`.
Bounds quadricBounds(const Quadric& quadric, const glm::mat4& matrix);

/// The gradient of the form at a point of the quadric's own space; on the surface it points to the outside.
glm::dvec3 quadricGradient(const Quadric& quadric, const glm::dvec3& point);

}  // namespace raylab
