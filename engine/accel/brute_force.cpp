#include "engine/accel/brute_force.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace raylab {
namespace {

/// Takes triangles in rising order of ids, so that the first of equal hits stays.
void testTriangle(const glm::dvec3& o, const glm::dvec3& d, double tMin, const glm::dvec3& p0, const glm::dvec3& p1,
                  const glm::dvec3& p2, uint32_t id, OracleHit& best) {
    const glm::dvec3 edge1 = p1 - p0;
    const glm::dvec3 edge2 = p2 - p0;
    const glm::dvec3 normal = glm::cross(d, edge2);
    const double determinant = glm::dot(edge1, normal);
    if (determinant == 0.0) return;
    const double reciprocal = 1.0 / determinant;
    const glm::dvec3 fromP0 = o - p0;
    const double u = glm::dot(fromP0, normal) * reciprocal;
    const glm::dvec3 q = glm::cross(fromP0, edge1);
    const double v = glm::dot(d, q) * reciprocal;
    const double t = glm::dot(edge2, q) * reciprocal;
    if (!(t > tMin)) return;
    const double inside = std::min({u, v, 1.0 - u - v});
    best.margin = std::min(best.margin, std::abs(inside));
    if (inside < 0.0) return;
    best.tNext = std::min(best.tNext, std::max(t, best.t));
    if (t < best.t) {
        best.t = t;
        best.u = u;
        best.v = v;
        best.primitive = id;
    }
}

}  // namespace

OracleHit closestHitDouble(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                           const glm::vec3& o, const glm::vec3& d, float tMin) {
    OracleHit best;
    for (size_t i = 0; i < triangles.size(); ++i) {
        const glm::uvec3& triangle = triangles[i];
        testTriangle(glm::dvec3(o), glm::dvec3(d), static_cast<double>(tMin), glm::dvec3(positions[triangle.x]),
                     glm::dvec3(positions[triangle.y]), glm::dvec3(positions[triangle.z]), static_cast<uint32_t>(i),
                     best);
    }
    return best;
}

std::vector<OracleHit> closestHitsDouble(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                                         std::span<const OracleRay> rays) {
    std::vector<OracleHit> hits(rays.size());
    tbb::parallel_for(size_t{0}, rays.size(), [&](size_t i) {
        hits[i] = closestHitDouble(positions, triangles, rays[i].o, rays[i].d, rays[i].tMin);
    });
    return hits;
}

}  // namespace raylab
