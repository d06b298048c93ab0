#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

namespace raylab {

struct OracleRay {
    glm::vec3 o;
    glm::vec3 d;  ///< of any length but zero; t is in its units
    float tMin = 0.0f;
};

constexpr uint32_t kNoPrimitive = 0xffffffffu;

struct OracleHit {
    double t = std::numeric_limits<double>::infinity();
    double u = 0.0;  ///< weight of the second vertex
    double v = 0.0;  ///< weight of the third vertex
    uint32_t primitive = kNoPrimitive;
    /// t of the closest hit on any other triangle: as close as `t`, the order of the two is not decidable in float.
    double tNext = std::numeric_limits<double>::infinity();
    /// How far, in barycentric coordinates, the ray passes from the closest edge (or its extension beyond a near miss)
    /// of any triangle whose plane it meets after tMin: close to 0, hit or miss is not decidable in float.
    double margin = std::numeric_limits<double>::infinity();

    bool hit() const { return primitive != kNoPrimitive; }
};

/// Moller and Trumbore's test in double precision over all triangles: an oracle for tests, independent of the trees and
/// of the float kernels. A hit has t > tMin; of equal ones the lowest id wins; a triangle parallel to the ray is
/// missed. Indices must be within `positions`.
OracleHit closestHitDouble(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                           const glm::vec3& o, const glm::vec3& d, float tMin);

/// As above for each ray, in parallel.
std::vector<OracleHit> closestHitsDouble(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                                         std::span<const OracleRay> rays);

}  // namespace raylab
