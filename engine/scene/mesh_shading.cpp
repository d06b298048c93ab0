#include "engine/scene/mesh_shading.h"

#include <cmath>

namespace raylab {
namespace {

/// Zero for a zero or non-finite vector.
glm::dvec3 unitOrZero(glm::dvec3 v) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

double angleBetween(glm::dvec3 unitA, glm::dvec3 unitB) {
    return std::acos(glm::clamp(glm::dot(unitA, unitB), -1.0, 1.0));
}

}  // namespace

glm::vec3 anyOrthogonal(glm::vec3 n) {
    // Duff et al. 2017, "Building an Orthonormal Basis, Revisited": no branch, no singularity.
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    return glm::vec3(1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x);
}

std::vector<glm::vec3> angleWeightedNormals(std::span<const glm::vec3> positions,
                                            std::span<const glm::uvec3> triangles) {
    std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0f));
    for (const glm::uvec3& triangle : triangles) {
        const glm::dvec3 p[3] = {positions[triangle.x], positions[triangle.y], positions[triangle.z]};
        // Double precision: the cross product of edges of 1e-20 underflows in float.
        const glm::dvec3 normal = unitOrZero(glm::cross(p[1] - p[0], p[2] - p[0]));
        const glm::dvec3 edges[3] = {unitOrZero(p[1] - p[0]), unitOrZero(p[2] - p[1]), unitOrZero(p[0] - p[2])};
        const double angle0 = angleBetween(edges[0], -edges[2]);
        const double angle1 = angleBetween(edges[1], -edges[0]);
        normals[triangle.x] += glm::vec3(normal * angle0);
        normals[triangle.y] += glm::vec3(normal * angle1);
        normals[triangle.z] += glm::vec3(normal * (3.14159265358979324 - angle0 - angle1));
    }
    for (glm::vec3& normal : normals) {
        const float length = glm::length(normal);
        normal = length > 1e-12f ? normal / length : glm::vec3(0.0f, 0.0f, 1.0f);
    }
    return normals;
}

std::vector<glm::vec4> vertexTangents(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                      std::span<const glm::vec2> uvs, std::span<const glm::uvec3> triangles) {
    std::vector<glm::dvec3> alongU(positions.size(), glm::dvec3(0.0));
    std::vector<glm::dvec3> alongV(positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& triangle : triangles) {
        const glm::dvec3 e1 = glm::dvec3(positions[triangle.y]) - glm::dvec3(positions[triangle.x]);
        const glm::dvec3 e2 = glm::dvec3(positions[triangle.z]) - glm::dvec3(positions[triangle.x]);
        const glm::dvec2 d1 = glm::dvec2(uvs[triangle.y]) - glm::dvec2(uvs[triangle.x]);
        const glm::dvec2 d2 = glm::dvec2(uvs[triangle.z]) - glm::dvec2(uvs[triangle.x]);
        const double determinant = d1.x * d2.y - d2.x * d1.y;
        if (determinant == 0.0) continue;
        // Scaled by the triangle's area, so that slivers do not outweigh their neighbours.
        const double weight = std::copysign(glm::length(glm::cross(e1, e2)), determinant);
        const glm::dvec3 u = unitOrZero(e1 * d2.y - e2 * d1.y) * weight;
        const glm::dvec3 v = unitOrZero(e2 * d1.x - e1 * d2.x) * weight;
        for (int corner = 0; corner < 3; ++corner) {
            alongU[triangle[corner]] += u;
            alongV[triangle[corner]] += v;
        }
    }
    std::vector<glm::vec4> tangents(positions.size());
    for (size_t i = 0; i < tangents.size(); ++i) {
        const glm::dvec3 n = normals[i];
        const glm::dvec3 tangent = unitOrZero(alongU[i] - n * glm::dot(n, alongU[i]));
        const glm::vec3 t = tangent == glm::dvec3(0.0) ? anyOrthogonal(normals[i]) : glm::vec3(tangent);
        const bool mirrored = glm::dot(glm::cross(n, glm::dvec3(t)), alongV[i]) > 0.0;
        tangents[i] = glm::vec4(t, mirrored ? -1.0f : 1.0f);
    }
    return tangents;
}

}  // namespace raylab
