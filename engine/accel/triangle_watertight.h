#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>

namespace raylab {

/// A ray as the watertight test wants it: the axis of the largest component of d becomes z, and a shear makes d (0, 0,
/// 1).
struct WatertightRay {
    glm::vec3 o;
    glm::vec3 d;
    int kx, ky, kz;
    float sx, sy, sz;
};

/// Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2013, section 3.1. `d` of any length but zero.
inline WatertightRay makeWatertightRay(const glm::vec3& o, const glm::vec3& d) {
    const glm::vec3 size = glm::abs(d);
    WatertightRay ray{};
    ray.o = o;
    ray.d = d;
    ray.kz = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    ray.kx = (ray.kz + 1) % 3;
    ray.ky = (ray.kx + 1) % 3;
    if (d[ray.kz] < 0.0f) std::swap(ray.kx, ray.ky);  // keeps the winding
    ray.sx = d[ray.kx] / d[ray.kz];
    ray.sy = d[ray.ky] / d[ray.kz];
    ray.sz = 1.0f / d[ray.kz];
    return ray;
}

/// The vertex seen from the origin of the ray, sheared; rounded to float, the same in every triangle that shares it.
inline glm::vec3 shearVertex(const WatertightRay& ray, const glm::vec3& p) {
    const glm::vec3 q = p - ray.o;
    return {q[ray.kx] - ray.sx * q[ray.kz], q[ray.ky] - ray.sy * q[ray.kz], ray.sz * q[ray.kz]};
}

/// Twice the area between the ray and an edge, from a to b. The products of two floats are exact in double, so the sign
/// is right and edge(a, b) == -edge(b, a) to the bit, whether or not the compiler fuses the subtraction. The paper's
/// float products give the same signs, or zero, where it falls back to double too.
inline double edgeFunction(const glm::vec3& a, const glm::vec3& b) {
    return static_cast<double>(a.x) * static_cast<double>(b.y) - static_cast<double>(a.y) * static_cast<double>(b.x);
}

/// Where the ray meets the triangle's plane, as planeDistance() in shaders/trace/triangle.glsl says: no nearer and no
/// farther than the vertices at `low` and `high`, of which the first is the answer for a plane that is seen edge-on.
inline float planeDistance(const WatertightRay& ray, const glm::dvec3& p0, const glm::dvec3& p1, const glm::dvec3& p2,
                           float low, float high) {
    const glm::dvec3 normal = glm::cross(p1 - p0, p2 - p0);
    const double slope = glm::dot(normal, glm::dvec3(ray.d));
    if (slope == 0.0) return low;
    return std::clamp(static_cast<float>(glm::dot(normal, p0 - glm::dvec3(ray.o)) / slope), low, high);
}

/// Two-sided and watertight: a ray never passes between two triangles that share an edge or a vertex.
/// A hit lies in tMin < t <= tMax, in units of the d that the ray was made of; u and v are the weights of p1 and p2.
/// t is that of the plane in double precision, so that it does not depend on the order of the vertices but for the last
/// rounding: see planeDistance().
inline bool intersectWatertight(const WatertightRay& ray, const glm::vec3& p0, const glm::vec3& p1, const glm::vec3& p2,
                                float tMin, float tMax, float& t, float& u, float& v) {
    const glm::vec3 a = shearVertex(ray, p0);
    const glm::vec3 b = shearVertex(ray, p1);
    const glm::vec3 c = shearVertex(ray, p2);
    const double weight0 = edgeFunction(c, b);
    const double weight1 = edgeFunction(a, c);
    const double weight2 = edgeFunction(b, a);
    const bool anyNegative = weight0 < 0.0 || weight1 < 0.0 || weight2 < 0.0;
    const bool anyPositive = weight0 > 0.0 || weight1 > 0.0 || weight2 > 0.0;
    if (anyNegative == anyPositive) return false;  // outside, or the ray lies in the plane
    const double reciprocal = 1.0 / (weight0 + weight1 + weight2);
    const auto [low, high] = std::minmax({a.z, b.z, c.z});
    const float distance = planeDistance(ray, p0, p1, p2, low, high);
    if (!(distance > tMin && distance <= tMax)) return false;
    t = distance;
    u = static_cast<float>(weight1 * reciprocal);
    v = static_cast<float>(weight2 * reciprocal);
    return true;
}

}  // namespace raylab
