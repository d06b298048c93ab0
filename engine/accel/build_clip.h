#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "engine/accel/aabb.h"

namespace raylab {

/// A triangle after clips, in double precision. One clip leaves at most half as many vertices more, also of a polygon
/// that rounding has made concave: 3, 4, 6, 9, 13, 19, 28 after six planes.
struct ClippedTriangle {
    static constexpr size_t kMostCorners = 28;
    std::array<glm::dvec3, kMostCorners> vertices;
    size_t size = 0;

    ClippedTriangle() = default;
    std::span<const glm::dvec3> corners() const { return {vertices.data(), size}; }
    /// Whole; nothing for kBoxAlone.
    ClippedTriangle(std::span<const glm::vec3> positions, const glm::uvec3& triangle);
    double area() const;
    /// Around the vertices, rounded outwards to float; empty without vertices.
    Aabb bounds() const;
};

/// The part where sign * (coordinate - plane) >= 0 (Sutherland and Hodgman 1974).
ClippedTriangle clip(const ClippedTriangle& polygon, int axis, double plane, double sign);

/// The part of a triangle inside a box; `around` is the triangle's own box.
ClippedTriangle clip(ClippedTriangle polygon, const Aabb& around, const Aabb& box);

}  // namespace raylab
