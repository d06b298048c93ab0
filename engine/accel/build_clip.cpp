#include "engine/accel/build_clip.h"

#include <cmath>
#include <limits>

#include "engine/accel/build_input.h"

namespace raylab {
namespace {

float roundDown(double value) {
    const auto nearest = static_cast<float>(value);
    if (static_cast<double>(nearest) <= value) return nearest;
    return std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

}  // namespace

ClippedTriangle::ClippedTriangle(std::span<const glm::vec3> positions, const glm::uvec3& triangle) {
    if (triangle == kBoxAlone) return;
    size = 3;
    for (int corner = 0; corner < 3; ++corner)
        vertices[static_cast<size_t>(corner)] = glm::dvec3(positions[triangle[corner]]);
}

double ClippedTriangle::area() const {
    glm::dvec3 sum(0.0);
    for (size_t i = 2; i < size; ++i) sum += glm::cross(vertices[i - 1] - vertices[0], vertices[i] - vertices[0]);
    return 0.5 * glm::length(sum);
}

Aabb ClippedTriangle::bounds() const {
    if (size == 0) return {};
    glm::dvec3 lo = vertices[0];
    glm::dvec3 hi = vertices[0];
    for (size_t i = 1; i < size; ++i) {
        lo = glm::min(lo, vertices[i]);
        hi = glm::max(hi, vertices[i]);
    }
    return {{roundDown(lo.x), roundDown(lo.y), roundDown(lo.z)},
            {-roundDown(-hi.x), -roundDown(-hi.y), -roundDown(-hi.z)}};
}

ClippedTriangle clip(const ClippedTriangle& polygon, int axis, double plane, double sign) {
    ClippedTriangle inside;
    for (size_t i = 0; i < polygon.size; ++i) {
        const glm::dvec3& a = polygon.vertices[i];
        const glm::dvec3& b = polygon.vertices[i + 1 == polygon.size ? 0 : i + 1];
        const double fromA = sign * (a[axis] - plane);
        const double fromB = sign * (b[axis] - plane);
        if (fromA >= 0.0) inside.vertices[inside.size++] = a;
        if ((fromA > 0.0 && fromB < 0.0) || (fromA < 0.0 && fromB > 0.0)) {
            glm::dvec3 crossing = a + (b - a) * (fromA / (fromA - fromB));
            crossing[axis] = plane;
            inside.vertices[inside.size++] = crossing;
        }
    }
    return inside;
}

ClippedTriangle clip(ClippedTriangle polygon, const Aabb& around, const Aabb& box) {
    for (int axis = 0; axis < 3; ++axis) {
        if (around.lo[axis] < box.lo[axis]) polygon = clip(polygon, axis, static_cast<double>(box.lo[axis]), 1.0);
        if (around.hi[axis] > box.hi[axis]) polygon = clip(polygon, axis, static_cast<double>(box.hi[axis]), -1.0);
    }
    return polygon;
}

}  // namespace raylab
