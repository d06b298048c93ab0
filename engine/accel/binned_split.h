#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "engine/accel/bvh.h"
#include "engine/accel/float4.h"

namespace raylab {

/// A primitive as the builder moves it around: 32 bytes, its id in the bits of the free lane.
struct PrimitiveRef {
    Float4 lo;  ///< lane 3: the id
    Float4 hi;

    PrimitiveRef() = default;
    /// Adding zero turns -0 into +0: the minimum of the two depends on the order of the operands.
    PrimitiveRef(const Aabb& box, uint32_t id) : lo(toFloat4(box.lo + 0.0f)), hi(toFloat4(box.hi + 0.0f)) {
        lo[3] = std::bit_cast<float>(id);
    }
    uint32_t id() const { return std::bit_cast<uint32_t>(static_cast<float>(lo[3])); }
    /// Twice the centroid, lane 3 zero: a factor of two changes no decision and saves a multiplication.
    Float4 centroid2() const {
        const Int4 xyz = {-1, -1, -1, 0};
        return reinterpret_cast<Float4>(reinterpret_cast<Int4>(lo + hi) & xyz);
    }
    float centroid2(int axis) const { return lo[axis] + hi[axis]; }
};

/// Which bin a centroid falls into, on the three axes at once. An axis without extent has scale 0: all in bin 0.
struct BinMapping {
    Float4 base;
    Float4 scale;

    BinMapping(const Box4& centroids2, int bins) : base(centroids2.lo), scale(splat(0.0f)) {
        // Below `bins` by more than the rounding of (c - base) * scale, so that the last centroid stays in the last
        // bin.
        const float reach = static_cast<float>(bins) * 0.99999f;
        for (int axis = 0; axis < 3; ++axis) {
            const float axisScale = reach / (centroids2.hi[axis] - centroids2.lo[axis]);
            if (std::isfinite(axisScale)) scale[axis] = axisScale;
        }
    }
    Int4 binsOf(const PrimitiveRef& ref) const { return truncate((ref.centroid2() - base) * scale); }
    int operator()(const PrimitiveRef& ref, int axis) const {
        return static_cast<int>((ref.centroid2(axis) - base[axis]) * scale[axis]);
    }
};

/// Nodes of up to so many primitives are swept exactly: each primitive has a bin to itself, its rank on the axis. That
/// is both cheaper than bins that stay empty, and better.
constexpr size_t kExactSweep = 16;

/// The ranks of the centroids of up to kExactSweep primitives on the three axes; equal ones keep their order.
class Ranks {
public:
    explicit Ranks(std::span<const PrimitiveRef> refs) : refs_(refs) {
        Float4 centroids[kExactSweep];
        for (size_t i = 0; i < refs.size(); ++i) {
            centroids[i] = refs[i].centroid2();
            ranks_[i] = splat(static_cast<int32_t>(i));
            for (size_t j = 0; j < i; ++j) {
                const Int4 before = centroids[i] < centroids[j];  // -1 where it is
                ranks_[i] += before;
                ranks_[j] -= before;
            }
        }
    }
    /// Of one of the `refs`, by its address.
    int operator()(const PrimitiveRef& ref, int axis) const { return ranks_[&ref - refs_.data()][axis]; }
    std::span<const PrimitiveRef> refs() const { return refs_; }

private:
    std::span<const PrimitiveRef> refs_;
    Int4 ranks_[kExactSweep];
};

/// Box and count of the primitives in each bin of each axis. Bins from `size` on are not initialised: in small nodes
/// that would take longer than the rest.
struct Bins {
    int size;
    Float4 lo[kMaxBvhBins][3];
    Float4 hi[kMaxBvhBins][3];
    Int4 counts[kMaxBvhBins];  ///< lane: axis

    explicit Bins(int size_) : size(size_) {
        for (int i = 0; i < size; ++i) {
            counts[i] = splat(0);
            for (int axis = 0; axis < 3; ++axis) set(i, axis, Box4());
        }
    }
    explicit Bins(const Ranks& ranks) : size(static_cast<int>(ranks.refs().size())) {
        for (int i = 0; i < size; ++i) {
            const PrimitiveRef& ref = ranks.refs()[static_cast<size_t>(i)];
            counts[i] = splat(1);
            for (int axis = 0; axis < 3; ++axis) set(ranks(ref, axis), axis, {ref.lo, ref.hi});
        }
    }

    void set(int bin, int axis, const Box4& box) {
        lo[bin][axis] = box.lo;
        hi[bin][axis] = box.hi;
    }
    void add(int bin, int axis, const Box4& box, int32_t count) {
        lo[bin][axis] = minimum(box.lo, lo[bin][axis]);
        hi[bin][axis] = maximum(box.hi, hi[bin][axis]);
        counts[bin][axis] += count;
    }
    Box4 box(int bin, int axis) const { return {lo[bin][axis], hi[bin][axis]}; }
    void add(const Bins& other) {
        for (int i = 0; i < size; ++i)
            for (int axis = 0; axis < 3; ++axis) add(i, axis, other.box(i, axis), other.counts[i][axis]);
    }
};

/// Primitives whose bin on `axis` is below `bin` go left. `cost` is the sum over both sides of half area times count.
struct BinnedSplit {
    float cost = std::numeric_limits<float>::infinity();
    int axis = -1;  ///< -1: no plane separates the centroids
    int bin = 0;
};

inline Float4 halfAreas(const Box4 (&boxes)[3]) {
    return halfAreas(boxes[0].hi - boxes[0].lo, boxes[1].hi - boxes[1].lo, boxes[2].hi - boxes[2].lo);
}

/// The cheapest of the planes between bins: a sweep from the right, then one from the left (Wald 2007, section 3.3).
/// The cost of a plane with an empty side is infinity * 0 = NaN, which loses every comparison.
inline BinnedSplit cheapestSplit(const Bins& bins) {
    Float4 rightCosts[kMaxBvhBins];
    Box4 boxes[3];
    Float4 count = splat(0.0f);
    for (int i = bins.size - 1; i > 0; --i) {
        for (int axis = 0; axis < 3; ++axis) boxes[axis].grow(bins.box(i, axis));
        count += toFloats(bins.counts[i]);
        rightCosts[i] = halfAreas(boxes) * count;
    }
    boxes[0] = boxes[1] = boxes[2] = Box4();
    count = splat(0.0f);
    Float4 bestCosts = splat(std::numeric_limits<float>::infinity());
    Int4 bestBins = {0, 0, 0, 0};
    for (int i = 1; i < bins.size; ++i) {
        for (int axis = 0; axis < 3; ++axis) boxes[axis].grow(bins.box(i - 1, axis));
        count += toFloats(bins.counts[i - 1]);
        const Float4 costs = halfAreas(boxes) * count + rightCosts[i];
        const Int4 better = costs < bestCosts;
        bestCosts = better ? costs : bestCosts;
        bestBins = better ? Int4{i, i, i, i} : bestBins;
    }
    BinnedSplit best;
    for (int axis = 0; axis < 3; ++axis)
        if (bestCosts[axis] < best.cost) best = {bestCosts[axis], axis, bestBins[axis]};
    return best;
}

}  // namespace raylab
