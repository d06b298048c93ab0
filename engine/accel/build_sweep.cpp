#include "engine/accel/build_sweep.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <limits>

#include "engine/accel/build_topdown.h"

namespace raylab {
namespace {

/// The first `leftSize` primitives along `axis` go left. `cost` as of BinnedSplit.
struct SweepSplit {
    float cost = std::numeric_limits<float>::infinity();
    int axis = -1;
    size_t leftSize = 0;
};

/// Primitives of one node as indices into `all`: along each axis in the order of their centroids.
struct SweepRange {
    const PrimitiveRef* all = nullptr;
    std::array<std::span<uint32_t>, 3> sorted;
    std::array<std::span<uint32_t>, 3> spare;
    std::array<std::span<float>, 3> costs;  ///< free to use
    Box4 bounds;

    size_t size() const { return sorted[0].size(); }
    const PrimitiveRef& ref(int axis, size_t i) const { return all[sorted[static_cast<size_t>(axis)][i]]; }
    void appendIds(std::vector<uint32_t>& ids) const {
        for (const uint32_t index : sorted[0]) ids.push_back(all[index].id());
    }
};

Box4 boundsOf(const SweepRange& range, int axis, size_t begin, size_t end) {
    Box4 box;
    for (size_t i = begin; i < end; ++i) box.grow(range.ref(axis, i).box());
    return box;
}

/// The cheapest split before one of the primitives begin .. end of an axis; `before` and `after` surround the others.
/// The first one has nothing before it where `begin` is 0, and loses with a cost of infinity * 0.
SweepSplit sweep(const SweepRange& range, int axis, size_t begin, size_t end, Box4 before, Box4 after) {
    const std::span<float> rightCosts = range.costs[static_cast<size_t>(axis)];
    for (size_t i = end; i-- > begin;) {
        after.grow(range.ref(axis, i).box());
        rightCosts[i] = after.halfArea() * static_cast<float>(range.size() - i);
    }
    SweepSplit best;
    for (size_t i = begin; i < end; ++i) {
        const float cost = before.halfArea() * static_cast<float>(i) + rightCosts[i];
        if (cost < best.cost) best = {cost, axis, i};
        before.grow(range.ref(axis, i).box());
    }
    return best;
}

SweepSplit cheaper(const SweepSplit& a, const SweepSplit& b) { return b.cost < a.cost ? b : a; }

/// As one sweep() over each axis, by chunks: first their boxes, then the sweeps of all of them.
SweepSplit sweepParallel(const SweepRange& range) {
    const size_t chunks = chunkCount(range.size());
    const auto forEach = [&](const auto& body) {
        parallelFor(3 * chunks, [&](size_t i) {
            const size_t begin = i % chunks * kChunk;
            body(i, static_cast<int>(i / chunks), begin, std::min(range.size(), begin + kChunk));
        });
    };
    std::vector<Box4> before(3 * chunks);
    forEach([&](size_t i, int axis, size_t begin, size_t end) { before[i] = boundsOf(range, axis, begin, end); });
    std::vector<Box4> after(3 * chunks);
    for (size_t first = 0; first < before.size(); first += chunks) {
        for (size_t i = chunks - 1; i-- > 0;) {
            after[first + i] = after[first + i + 1];
            after[first + i].grow(before[first + i + 1]);
        }
        Box4 sum;
        for (size_t i = 0; i < chunks; ++i) {
            std::swap(sum, before[first + i]);
            sum.grow(before[first + i]);
        }
    }
    std::vector<SweepSplit> splits(3 * chunks);
    forEach([&](size_t i, int axis, size_t begin, size_t end) {
        splits[i] = sweep(range, axis, begin, end, before[i], after[i]);
    });
    return std::accumulate(splits.begin(), splits.end(), SweepSplit(), cheaper);
}

SweepSplit cheapestSplit(const SweepRange& range) {
    if (range.size() > kParallelPass) return sweepParallel(range);
    SweepSplit best;
    for (int axis = 0; axis < 3; ++axis) best = cheaper(best, sweep(range, axis, 0, range.size(), {}, {}));
    return best;
}

/// Halves along the axis on which the centroids spread most.
SweepSplit medianSplit(const SweepRange& range) {
    Box4 centroids2;
    for (int axis = 0; axis < 3; ++axis) {
        centroids2.lo[axis] = range.ref(axis, 0).centroid2(axis);
        centroids2.hi[axis] = range.ref(axis, range.size() - 1).centroid2(axis);
    }
    return {0.0f, longestAxis(centroids2), range.size() / 2};
}

/// For partitionInOrder(): nothing to see.
struct Nothing {
    void add(uint32_t /*index*/, int /*isLeft*/) {}
    void add(const Nothing& /*other*/) {}
};

struct SweepSplitter {
    using Range = SweepRange;
    const BvhConfig& config;
    uint8_t* isLeft;  ///< one of each primitive, free to use

    std::optional<Sides<Range>> split(const Range& range, int levelsLeft) const {
        const size_t size = range.size();
        if (mustBeLeaf(size, levelsLeft, config)) return std::nullopt;
        SweepSplit best = cheapestSplit(range);
        if (isLeafCheaper(size, range.bounds.halfArea(), best.cost, config)) return std::nullopt;
        if (best.axis < 0 || !fits(std::max(best.leftSize, size - best.leftSize), levelsLeft - 1, config))
            best = medianSplit(range);
        return divide(range, best);
    }

    Sides<Range> divide(Range range, const SweepSplit& split) const {
        const std::span<const uint32_t> sorted = range.sorted[static_cast<size_t>(split.axis)];
        std::vector<Sides<Box4>> boxes(chunkCount(range.size()));
        forEachChunk(range.size(), [&](size_t chunk, size_t begin, size_t end) {
            const size_t middle = std::clamp(split.leftSize, begin, end);
            for (size_t i = begin; i < end; ++i) isLeft[sorted[i]] = i < middle ? 1 : 0;
            boxes[chunk].left = boundsOf(range, split.axis, begin, middle);
            boxes[chunk].right = boundsOf(range, split.axis, middle, end);
        });
        for (int axis = 0; axis < 3; ++axis) {
            if (axis == split.axis) continue;
            partitionInOrder<Nothing>(range.sorted[static_cast<size_t>(axis)], range.spare[static_cast<size_t>(axis)],
                                      split.leftSize, [this](uint32_t index) { return isLeft[index] != 0; });
        }
        Sides<Range> sides = cut(range, split.leftSize);
        for (const Sides<Box4>& chunk : boxes) {
            sides.left.bounds.grow(chunk.left);
            sides.right.bounds.grow(chunk.right);
        }
        return sides;
    }

    static Sides<Range> cut(const Range& range, size_t leftSize) {
        Sides<Range> sides;
        sides.left.all = sides.right.all = range.all;
        for (size_t axis = 0; axis < 3; ++axis) {
            sides.left.sorted[axis] = range.sorted[axis].first(leftSize);
            sides.left.spare[axis] = range.spare[axis].first(leftSize);
            sides.left.costs[axis] = range.costs[axis].first(leftSize);
            sides.right.sorted[axis] = range.sorted[axis].subspan(leftSize);
            sides.right.spare[axis] = range.spare[axis].subspan(leftSize);
            sides.right.costs[axis] = range.costs[axis].subspan(leftSize);
        }
        return sides;
    }
};

/// The memory of a build.
struct SweepArrays {
    std::array<std::vector<uint32_t>, 3> sorted;
    std::array<std::vector<uint32_t>, 3> spare;
    std::array<std::vector<float>, 3> costs;
    std::vector<uint8_t> isLeft;

    explicit SweepArrays(std::span<const PrimitiveRef> refs) : isLeft(refs.size()) {
        for (size_t axis = 0; axis < 3; ++axis) {
            sorted[axis].resize(refs.size());
            spare[axis].resize(refs.size());
            costs[axis].resize(refs.size());
        }
        parallelFor(3, [&](size_t axis) { sort(refs, static_cast<int>(axis), sorted[axis]); });
    }
    /// Indices are in the order of ids, so no two are equal and the order is the only one.
    static void sort(std::span<const PrimitiveRef> refs, int axis, std::span<uint32_t> sorted) {
        std::vector<std::pair<float, uint32_t>> keys(refs.size());
        for (uint32_t i = 0; i < refs.size(); ++i) keys[i] = {refs[i].centroid2(axis), i};
        if (keys.size() > kParallelPass)
            tbb::parallel_sort(keys);
        else
            std::sort(keys.begin(), keys.end());
        for (size_t i = 0; i < keys.size(); ++i) sorted[i] = keys[i].second;
    }
};

}  // namespace

Bvh buildSweep(std::span<const Aabb> bounds, const BvhConfig& config, const BuildControl& control) {
    checkConfig(config, bounds.size());
    std::unique_ptr<PrimitiveRef[]> refs;
    const PrimitiveRange usable = collectRefs(bounds, refs);
    SweepArrays arrays(usable.refs);
    SweepRange range;
    range.all = refs.get();
    range.bounds = usable.bounds;
    for (size_t axis = 0; axis < 3; ++axis) {
        range.sorted[axis] = arrays.sorted[axis];
        range.spare[axis] = arrays.spare[axis];
        range.costs[axis] = arrays.costs[axis];
    }
    Bvh bvh = buildTopDown(range, SweepSplitter{config, arrays.isLeft.data()}, config, control, usable.size());
    bvh.skipped = bounds.size() - usable.size();
    return bvh;
}

}  // namespace raylab
