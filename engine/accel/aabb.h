#pragma once

#include <glm/glm.hpp>
#include <limits>

namespace raylab {

/// Largest magnitude of a coordinate that the structures accept. Up to here surface areas summed over 1e7 primitives,
/// products of two edges and slab distances with 1/d clamped to 1e20 stay finite in binary32; a box that reaches
/// further is treated like a non-finite one and left out.
constexpr float kLargestCoordinate = 1e15f;

/// Axis-aligned box, closed at both ends. As constructed it is empty: it contains nothing and is neutral to grow().
struct Aabb {
    glm::vec3 lo{std::numeric_limits<float>::infinity()};
    glm::vec3 hi{-std::numeric_limits<float>::infinity()};

    void grow(const glm::vec3& point) {
        lo = glm::min(lo, point);
        hi = glm::max(hi, point);
    }
    void grow(const Aabb& box) {
        lo = glm::min(lo, box.lo);
        hi = glm::max(hi, box.hi);
    }
    /// True also where a coordinate is NaN.
    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    /// Not empty and within kLargestCoordinate: what a builder takes in.
    bool usable() const {
        return !empty() && lo.x >= -kLargestCoordinate && lo.y >= -kLargestCoordinate && lo.z >= -kLargestCoordinate &&
               hi.x <= kLargestCoordinate && hi.y <= kLargestCoordinate && hi.z <= kLargestCoordinate;
    }
    bool contains(const Aabb& box) const {
        return glm::all(glm::lessThanEqual(lo, box.lo)) && glm::all(glm::greaterThanEqual(hi, box.hi));
    }
    glm::vec3 extent() const { return hi - lo; }
    glm::vec3 centroid() const { return 0.5f * lo + 0.5f * hi; }
    /// Half of the surface area, which is what ratios of areas need. Not for empty boxes.
    float halfArea() const {
        const glm::vec3 e = extent();
        return e.x * (e.y + e.z) + e.y * e.z;
    }
};

}  // namespace raylab
