#include "engine/accel/triangle_bounds.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace raylab {
namespace {

bool hasArea(const glm::vec3& p0, const glm::vec3& p1, const glm::vec3& p2) {
    const glm::dvec3 normal = glm::cross(glm::dvec3(p1) - glm::dvec3(p0), glm::dvec3(p2) - glm::dvec3(p0));
    return normal != glm::dvec3(0.0);
}

Aabb boundsOf(std::span<const glm::vec3> positions, const glm::uvec3& triangle) {
    if (triangle.x >= positions.size() || triangle.y >= positions.size() || triangle.z >= positions.size()) return {};
    const glm::vec3& p0 = positions[triangle.x];
    const glm::vec3& p1 = positions[triangle.y];
    const glm::vec3& p2 = positions[triangle.z];
    if (!hasArea(p0, p1, p2)) return {};
    // Through the sum, as glm::min and glm::max drop a NaN.
    const glm::vec3 sum = p0 + p1 + p2;
    Aabb box{glm::min(glm::min(p0, p1), p2), glm::max(glm::max(p0, p1), p2)};
    return box.usable() && sum == sum ? box : Aabb{};
}

}  // namespace

std::vector<Aabb> triangleBounds(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
    std::vector<Aabb> bounds(triangles.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, triangles.size(), 4096), [&](const auto& range) {
        for (size_t i = range.begin(); i != range.end(); ++i) bounds[i] = boundsOf(positions, triangles[i]);
    });
    return bounds;
}

}  // namespace raylab
