#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace raylab {

/// Appends the triangles of a simple polygon to `triangles`, with its winding: corners.size() - 2 of them. A fan where
/// the polygon is convex, else ear clipping (Meisters 1975, "Polygons Have Ears") in the plane of its Newell normal. A
/// polygon that crosses itself or has no area becomes a fan. Every corner must be below positions.size().
void triangulatePolygon(std::span<const uint32_t> corners, std::span<const glm::vec3> positions,
                        std::vector<glm::uvec3>& triangles);

}  // namespace raylab
