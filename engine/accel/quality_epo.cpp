#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <array>
#include <functional>

#include "engine/accel/quality.h"

namespace raylab {
namespace {

/// A triangle after clips. One clip leaves at most half as many vertices more, also of a polygon that rounding has made
/// concave: 3, 4, 6, 9, 13, 19, 28 after six planes.
struct Polygon {
    std::array<glm::dvec3, 28> vertices;
    size_t size = 0;

    double area() const {
        glm::dvec3 sum(0.0);
        for (size_t i = 2; i < size; ++i) sum += glm::cross(vertices[i - 1] - vertices[0], vertices[i] - vertices[0]);
        return 0.5 * glm::length(sum);
    }
};

/// The part where sign * (coordinate - plane) >= 0 (Sutherland and Hodgman 1974).
Polygon clip(const Polygon& polygon, int axis, double plane, double sign) {
    Polygon inside;
    for (size_t i = 0; i < polygon.size; ++i) {
        const glm::dvec3& a = polygon.vertices[i];
        const glm::dvec3& b = polygon.vertices[(i + 1) % polygon.size];
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

/// The part of a triangle inside a box; `around` is the triangle's own box.
Polygon clip(Polygon polygon, const Aabb& around, const Aabb& box) {
    for (int axis = 0; axis < 3; ++axis) {
        if (around.lo[axis] < box.lo[axis]) polygon = clip(polygon, axis, static_cast<double>(box.lo[axis]), 1.0);
        if (around.hi[axis] > box.hi[axis]) polygon = clip(polygon, axis, static_cast<double>(box.hi[axis]), -1.0);
    }
    return polygon;
}

bool overlap(const Aabb& a, const Aabb& b) {
    return glm::all(glm::lessThanEqual(a.lo, b.hi)) && glm::all(glm::lessThanEqual(b.lo, a.hi));
}

/// Slots of Bvh::order below a node.
struct Slots {
    uint32_t begin;
    uint32_t end;
    bool hold(size_t slot) const { return slot >= begin && slot < end; }
};

std::vector<Slots> slotsBelow(const Bvh& bvh) {
    std::vector<Slots> slots(bvh.nodes.size());
    for (size_t i = bvh.nodes.size(); i-- > 0;) {
        const BvhNode& node = bvh.nodes[i];
        slots[i] = node.isLeaf() ? Slots{node.first, node.first + node.count}
                                 : Slots{slots[node.left].begin, slots[node.left + 1].end};
    }
    return slots;
}

struct Overlap {
    const Bvh& bvh;
    const BvhConfig& config;
    const std::vector<Slots>& slots;
    size_t slot;
    Polygon triangle;
    Aabb around;

    double cost(const BvhNode& node) const {
        return node.isLeaf() ? static_cast<double>(config.intersectionCost) * node.count
                             : static_cast<double>(config.traversalCost);
    }
    /// Cost times area of the triangle inside, over the nodes of this subtree that do not hold the triangle.
    double below(size_t index) const {
        const BvhNode& node = bvh.nodes[index];
        double sum = 0.0;
        if (!slots[index].hold(slot)) {
            if (!overlap(node.bounds, around)) return 0.0;
            const double area = clip(triangle, around, node.bounds).area();
            if (!(area > 0.0)) return 0.0;
            sum = cost(node) * area;
        }
        return node.isLeaf() ? sum : sum + below(node.left) + below(node.left + 1);
    }
};

struct Sums {
    double overlap = 0.0;
    double area = 0.0;
};

Sums operator+(const Sums& a, const Sums& b) { return {a.overlap + b.overlap, a.area + b.area}; }

}  // namespace

double measureEpo(const Bvh& bvh, std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                  const BvhConfig& config) {
    if (bvh.nodes.empty()) return 0.0;
    const std::vector<Slots> slots = slotsBelow(bvh);
    const auto addTriangle = [&](size_t slot) -> Sums {
        const glm::uvec3& triangle = triangles[bvh.order[slot]];
        Polygon polygon;
        Aabb box;
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3& position = positions[triangle[corner]];
            polygon.vertices[polygon.size++] = glm::dvec3(position);
            box.grow(position);
        }
        return {Overlap{bvh, config, slots, slot, polygon, box}.below(0), polygon.area()};
    };
    const Sums sums = tbb::parallel_deterministic_reduce(
        tbb::blocked_range<size_t>(0, bvh.order.size(), 1024), Sums{},
        [&](const tbb::blocked_range<size_t>& range, Sums partial) {
            for (size_t slot = range.begin(); slot != range.end(); ++slot) partial = partial + addTriangle(slot);
            return partial;
        },
        std::plus<>());
    return sums.area > 0.0 ? sums.overlap / sums.area : 0.0;
}

}  // namespace raylab
