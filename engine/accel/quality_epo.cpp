#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "engine/accel/build_clip.h"
#include "engine/accel/quality.h"

namespace raylab {
namespace {

bool overlap(const Aabb& a, const Aabb& b) {
    return glm::all(glm::lessThanEqual(a.lo, b.hi)) && glm::all(glm::lessThanEqual(b.lo, a.hi));
}

/// Slots of Bvh::order below a node.
struct Slots {
    uint32_t begin;
    uint32_t end;
    /// Whether any of some slots, in order, is below the node: one slot but for duplicated primitives.
    bool holdAny(std::span<const uint32_t> slots) const {
        const auto next = std::lower_bound(slots.begin(), slots.end(), begin);
        return next != slots.end() && *next < end;
    }
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

/// The slots of Bvh::order that hold each primitive, in order.
struct SlotsOfPrimitives {
    std::vector<uint32_t> slots;
    std::vector<uint32_t> firsts;  ///< of primitive i: slots[firsts[i]] to slots[firsts[i + 1]]

    SlotsOfPrimitives(const std::vector<uint32_t>& order, size_t primitives)
        : slots(order.size()), firsts(primitives + 1, 0) {
        for (const uint32_t primitive : order) ++firsts[primitive];
        std::partial_sum(firsts.begin(), firsts.end(), firsts.begin());
        for (size_t slot = order.size(); slot-- > 0;) slots[--firsts[order[slot]]] = static_cast<uint32_t>(slot);
    }
    std::span<const uint32_t> of(size_t primitive) const {
        return std::span(slots).subspan(firsts[primitive], firsts[primitive + 1] - firsts[primitive]);
    }
};

struct Overlap {
    const Bvh& bvh;
    const BvhConfig& config;
    const std::vector<Slots>& slots;
    std::span<const uint32_t> held;  ///< the triangle's own
    ClippedTriangle triangle;
    Aabb around;

    double cost(const BvhNode& node) const {
        return node.isLeaf() ? static_cast<double>(config.intersectionCost) * node.count
                             : static_cast<double>(config.traversalCost);
    }
    /// Cost times area of the triangle inside, over the nodes of this subtree that do not hold the triangle.
    double below(size_t index) const {
        const BvhNode& node = bvh.nodes[index];
        double sum = 0.0;
        if (!slots[index].holdAny(held)) {
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
    const SlotsOfPrimitives slotsOf(bvh.order, triangles.size());
    const auto addTriangle = [&](size_t primitive) -> Sums {
        const std::span<const uint32_t> held = slotsOf.of(primitive);
        if (held.empty()) return {};
        const ClippedTriangle triangle(positions, triangles[primitive]);
        return {Overlap{bvh, config, slots, held, triangle, triangle.bounds()}.below(0), triangle.area()};
    };
    const Sums sums = tbb::parallel_deterministic_reduce(
        tbb::blocked_range<size_t>(0, triangles.size(), 1024), Sums{},
        [&](const tbb::blocked_range<size_t>& range, Sums partial) {
            for (size_t i = range.begin(); i != range.end(); ++i) partial = partial + addTriangle(i);
            return partial;
        },
        std::plus<>());
    return sums.area > 0.0 ? sums.overlap / sums.area : 0.0;
}

}  // namespace raylab
