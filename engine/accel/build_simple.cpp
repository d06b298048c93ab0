#include "engine/accel/build_simple.h"

#include <algorithm>

#include "engine/accel/build_topdown.h"

namespace raylab {
namespace {

struct MedianSplitter {
    using Range = PrimitiveRange;
    const BvhConfig& config;

    std::optional<Sides<Range>> split(const Range& range, int /*levelsLeft*/) const {
        if (mayBeLeaf(range.size(), config)) return std::nullopt;
        return splitAtMedian(range);
    }
};

/// Left of a plane, for parallelSum().
struct LeftCount {
    std::span<const PrimitiveRef> refs;
    int axis;
    float plane2;
    size_t count = 0;

    bool operator()(const PrimitiveRef& ref) const { return ref.centroid2(axis) < plane2; }
    void add(size_t begin, size_t end) {
        count += static_cast<size_t>(std::count_if(refs.begin() + begin, refs.begin() + end, *this));
    }
    void add(const LeftCount& other) { count += other.count; }
};

struct MidpointSplitter {
    using Range = PrimitiveRange;
    const BvhConfig& config;

    std::optional<Sides<Range>> split(const Range& range, int levelsLeft) const {
        const size_t size = range.size();
        if (mayBeLeaf(size, config)) return std::nullopt;
        const int axis = longestAxis(range.centroids2);
        LeftCount left{range.refs, axis, 0.5f * range.centroids2.lo[axis] + 0.5f * range.centroids2.hi[axis]};
        if (size > kParallelPass)
            left = parallelSum(size, left);
        else
            left.add(0, size);
        const size_t smaller = std::min(left.count, size - left.count);
        if (smaller == 0 || !fits(size - smaller, levelsLeft - 1, config)) return splitAtMedian(range);
        Sides<Range> sides = partition(range, left.count, left);
        computeBoxes(sides.left);
        computeBoxes(sides.right);
        return sides;
    }
};

}  // namespace

Bvh buildMidpoint(std::span<const Aabb> bounds, const BvhConfig& config, const BuildControl& control) {
    return buildOverRefs(bounds, MidpointSplitter{config}, config, control);
}

Bvh buildMedian(std::span<const Aabb> bounds, const BvhConfig& config, const BuildControl& control) {
    return buildOverRefs(bounds, MedianSplitter{config}, config, control);
}

}  // namespace raylab
