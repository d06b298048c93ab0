#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

namespace raylab::oracle {

/// In double precision; lo > hi: nothing in it.
struct Box {
    glm::dvec3 lo{std::numeric_limits<double>::infinity()};
    glm::dvec3 hi{-std::numeric_limits<double>::infinity()};

    bool isEmpty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    /// The largest sizes of coordinates.
    glm::dvec3 farthest() const { return glm::max(glm::abs(lo), glm::abs(hi)); }
    void include(const glm::dvec3& point) {
        lo = glm::min(lo, point);
        hi = glm::max(hi, point);
    }
    void include(const Box& box) {
        lo = glm::min(lo, box.lo);
        hi = glm::max(hi, box.hi);
    }
};

/// A ray, and by how much boxes are to be widened for it: by `padAlways`, and by `padPerDistance` of the largest
/// coordinate of the box as seen from the origin.
struct PaddedRay {
    glm::dvec3 origin;
    glm::dvec3 direction;
    double tMin;
    double padPerDistance;
    double padAlways;
};

/// A binary tree over boxes, split at the median along the longest axis until at most four are left: a complete tree,
/// node i above 2i + 1 and 2i + 2, that needs no links.
class PaddedTree {
public:
    /// Empty boxes are left out.
    explicit PaddedTree(const std::vector<Box>& boxes);

    /// Of everything.
    const Box& bounds() const { return nodes_[0]; }

    /// Calls `visit(index)` for all boxes (and some of their neighbours) that the widened ray meets at a t up to
    /// `tFar`, which visit may lower; near ones rather first.
    template <class Visit>
    void walk(const PaddedRay& ray, const double& tFar, const Visit& visit) const {
        std::array<Entry, kMaxDepth> stack;
        size_t size = 0;
        stack[size++] = {0, 0, order_.size(), entryOf(ray, nodes_[0])};
        while (size > 0) {
            const Entry entry = stack[--size];
            if (entry.t == std::numeric_limits<double>::infinity() || entry.t > tFar) continue;
            if (entry.node >= firstLeaf_) {
                for (size_t i = entry.first; i < entry.last; ++i) visit(order_[i]);
                continue;
            }
            const size_t middle = entry.first + (entry.last - entry.first) / 2;
            const size_t child = 2 * entry.node + 1;
            const Entry left{child, entry.first, middle, entryOf(ray, nodes_[child])};
            const Entry right{child + 1, middle, entry.last, entryOf(ray, nodes_[child + 1])};
            stack[size++] = left.t < right.t ? right : left;
            stack[size++] = left.t < right.t ? left : right;
        }
    }

private:
    static constexpr size_t kMaxDepth = 64;  ///< 2^64 boxes are out of reach

    struct Entry {
        size_t node;
        size_t first;  ///< range of order_
        size_t last;
        double t;  ///< where the ray enters; infinite where it misses
    };

    static double entryOf(const PaddedRay& ray, const Box& box);
    void build(const std::vector<Box>& boxes, size_t node, size_t first, size_t last);

    std::vector<Box> nodes_;
    std::vector<uint32_t> order_;
    size_t firstLeaf_ = 0;
};

}  // namespace raylab::oracle
