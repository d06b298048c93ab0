#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "engine/accel/build_range.h"

namespace raylab {

/// Which of the equal bins between the planes of a box a point falls into, on the three axes at once: twice a centroid,
/// in a box of twice the centroids, or any other. An axis without extent has scale 0: all in bin 0.
struct BinMapping {
    Float4 base;
    Float4 scale;

    BinMapping(const Box4& box, int bins) : base(box.lo), scale(splat(0.0f)) {
        // Below `bins` by more than the rounding of (p - base) * scale, so that the last point stays in the last bin.
        const float reach = static_cast<float>(bins) * 0.99999f;
        for (int axis = 0; axis < 3; ++axis) {
            const float axisScale = reach / (box.hi[axis] - box.lo[axis]);
            if (std::isfinite(axisScale)) scale[axis] = axisScale;
        }
    }
    Int4 binsOf(Float4 point) const { return truncate((point - base) * scale); }
    Int4 binsOf(const PrimitiveRef& ref) const { return binsOf(ref.centroid2()); }
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
    void grow(int bin, int axis, const Box4& box) {
        lo[bin][axis] = minimum(box.lo, lo[bin][axis]);
        hi[bin][axis] = maximum(box.hi, hi[bin][axis]);
    }
    void add(int bin, int axis, const Box4& box, int32_t count) {
        grow(bin, axis, box);
        counts[bin][axis] += count;
    }
    Box4 box(int bin, int axis) const { return {lo[bin][axis], hi[bin][axis]}; }
    /// The union of the boxes of the bins from `begin` to `end` of an axis.
    Box4 box(int begin, int end, int axis) const {
        Box4 all;
        for (int i = begin; i < end; ++i) all.grow(box(i, axis));
        return all;
    }
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
/// The cost of a plane with an empty side is infinity * 0 = NaN, which loses every comparison. `rightCounts` are what
/// counts to the right of a plane, where that is not what `bins` holds.
inline BinnedSplit cheapestSplit(const Bins& bins, const Int4* rightCounts) {
    Float4 rightCosts[kMaxBvhBins];
    Box4 boxes[3];
    Float4 count = splat(0.0f);
    for (int i = bins.size - 1; i > 0; --i) {
        for (int axis = 0; axis < 3; ++axis) boxes[axis].grow(bins.box(i, axis));
        count += toFloats(rightCounts[i]);
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
inline BinnedSplit cheapestSplit(const Bins& bins) { return cheapestSplit(bins, bins.counts); }

inline void addToBins(std::span<const PrimitiveRef> refs, const BinMapping& mapping, Bins& bins) {
    for (const PrimitiveRef& ref : refs) {
        const Int4 bin = mapping.binsOf(ref);
        for (int axis = 0; axis < 3; ++axis) bins.add(bin[axis], axis, ref.box(), 1);
    }
}

/// For parallelSum().
struct BinsOfRefs {
    std::span<const PrimitiveRef> refs;
    BinMapping mapping;
    Bins bins;

    void add(size_t begin, size_t end) { addToBins(refs.subspan(begin, end - begin), mapping, bins); }
    void add(const BinsOfRefs& other) { bins.add(other.bins); }
};

/// use(bins, binOf) with the bins of the centroids, as many as primitives in nodes of up to kExactSweep of them;
/// binOf(ref, axis) is a primitive's.
template <class Use>
auto useBins(std::span<const PrimitiveRef> refs, const Box4& centroids2, int count, const Use& use) {
    if (refs.size() <= kExactSweep) {
        const Ranks ranks(refs);
        return use(Bins(ranks), ranks);
    }
    const BinMapping mapping(centroids2, count);
    if (refs.size() > kParallelPass)
        return use(parallelSum(refs.size(), BinsOfRefs{refs, mapping, Bins(count)}).bins, mapping);
    Bins bins(count);
    addToBins(refs, mapping, bins);
    return use(bins, mapping);
}

}  // namespace raylab
