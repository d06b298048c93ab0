#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/accel/build_parallel.h"
#include "engine/accel/bvh.h"
#include "engine/accel/float4.h"

namespace raylab {

/// A primitive as the builders move it around: 32 bytes, its id in the bits of the free lane.
struct PrimitiveRef {
    Float4 lo;  ///< lane 3: the id
    Float4 hi;

    PrimitiveRef() = default;
    /// Adding zero turns -0 into +0: the minimum of the two depends on the order of the operands.
    PrimitiveRef(const Aabb& box, uint32_t id) : lo(toFloat4(box.lo + 0.0f)), hi(toFloat4(box.hi + 0.0f)) {
        lo[3] = std::bit_cast<float>(id);
    }
    uint32_t id() const { return std::bit_cast<uint32_t>(static_cast<float>(lo[3])); }
    Box4 box() const { return {lo, hi}; }
    /// Twice the centroid, lane 3 zero: a factor of two changes no decision and saves a multiplication.
    Float4 centroid2() const {
        const Int4 xyz = {-1, -1, -1, 0};
        return reinterpret_cast<Float4>(reinterpret_cast<Int4>(lo + hi) & xyz);
    }
    float centroid2(int axis) const { return lo[axis] + hi[axis]; }
};

void appendIds(std::span<const PrimitiveRef> refs, std::vector<uint32_t>& ids);

/// Primitives of one node. `spare` is as long as `refs` and free to use.
struct PrimitiveRange {
    std::span<PrimitiveRef> refs;
    std::span<PrimitiveRef> spare;
    Box4 bounds;
    Box4 centroids2;

    size_t size() const { return refs.size(); }
    void appendIds(std::vector<uint32_t>& ids) const { raylab::appendIds(refs, ids); }
};

template <class Range>
struct Sides {
    Range left;
    Range right;
};

inline Box4 toBox4(const Aabb& box) { return {toFloat4(box.lo), toFloat4(box.hi)}; }
inline Aabb toAabb(const Box4& box) { return {toVec3(box.lo), toVec3(box.hi)}; }
inline bool isEmpty(const Box4& box) { return toAabb(box).empty(); }
/// Empty where they are apart.
inline Box4 intersection(const Box4& a, const Box4& b) { return {maximum(a.lo, b.lo), minimum(a.hi, b.hi)}; }
/// Of boxes without NaN; the first of equally long axes.
inline int longestAxis(const Box4& box) {
    const Float4 extent = box.hi - box.lo;
    return extent[0] >= extent[1] && extent[0] >= extent[2] ? 0 : extent[1] >= extent[2] ? 1 : 2;
}

/// Throws Error for a config out of its ranges, or one whose maxDepth and maxLeafSize cannot hold the primitives.
void checkConfig(const BvhConfig& config, size_t primitives);

/// Whether a subtree of `levels` levels below its root can hold that many primitives. A node that fits has a split at
/// the median whose sides fit one level below.
inline bool fits(size_t size, int levels, const BvhConfig& config) {
    return size <= static_cast<size_t>(config.maxLeafSize) << std::min(levels, 40);
}
inline bool mayBeLeaf(size_t size, const BvhConfig& config) { return size <= static_cast<size_t>(config.maxLeafSize); }
inline bool mustBeLeaf(size_t size, int levelsLeft, const BvhConfig& config) {
    return size == 1 || (mayBeLeaf(size, config) && levelsLeft == 0);
}
/// `cost`: the sum over both sides of half area times count; `area`: half of the node's.
inline bool isLeafCheaper(size_t size, float area, float cost, const BvhConfig& config) {
    const float splitCost = config.traversalCost * area + config.intersectionCost * cost;
    const float leafCost = config.intersectionCost * area * static_cast<float>(size);
    return mayBeLeaf(size, config) && !(splitCost < leafCost);
}

/// The usable primitives, in order, with the boxes around them; `refs` is allocated here, with room for `room` more.
/// Fills in all of the range but `spare`.
PrimitiveRange collectRefs(std::span<const Aabb> bounds, std::unique_ptr<PrimitiveRef[]>& refs, size_t room = 0);

/// Reorders the primitives into halves along the axis on which the centroids spread most, equal ones by id; returns
/// the size of the first half, half of all rounded down.
size_t orderByMedian(std::span<PrimitiveRef> refs, const Box4& centroids2);

/// Halves of equal size as of orderByMedian(): bounds the depth on any input.
Sides<PrimitiveRange> splitAtMedian(const PrimitiveRange& range);

/// Moves items to `left` and `right`, in order and without branches, and tells `seen` of each. `left` may be where the
/// items are.
template <class Seen, class T, class GoesLeft>
Seen distribute(std::span<const T> items, const GoesLeft& goesLeft, T* left, T* right) {
    Seen seen;
    T* next[2] = {right, left};  // a table instead of a condition: sides are as good as random
    for (const T& item : items) {
        const int isLeft = goesLeft(item) ? 1 : 0;
        seen.add(item, isLeft);
        *next[isLeft] = item;
        ++next[isLeft];
    }
    return seen;
}

/// As partitionInOrder(), chunks in parallel: the items end up in what was spare.
template <class Seen, class T, class GoesLeft>
Seen partitionInOrderParallel(std::span<T> items, std::span<T> spare, size_t leftSize, const GoesLeft& goesLeft) {
    std::vector<size_t> leftBefore(chunkCount(items.size()) + 1, 0);
    forEachChunk(items.size(), [&](size_t chunk, size_t begin, size_t end) {
        leftBefore[chunk + 1] =
            static_cast<size_t>(std::count_if(items.begin() + begin, items.begin() + end, goesLeft));
    });
    std::partial_sum(leftBefore.begin(), leftBefore.end(), leftBefore.begin());
    std::vector<Seen> seen(chunkCount(items.size()));
    forEachChunk(items.size(), [&](size_t chunk, size_t begin, size_t end) {
        T* left = spare.data() + leftBefore[chunk];
        T* right = spare.data() + leftSize + (begin - leftBefore[chunk]);
        seen[chunk] = distribute<Seen, T>(items.subspan(begin, end - begin), goesLeft, left, right);
    });
    for (size_t chunk = 1; chunk < seen.size(); ++chunk) seen[0].add(seen[chunk]);
    return seen[0];
}

/// Brings the `leftSize` items that go left before the others, both in order; `items` and `spare` may change places.
template <class Seen, class T, class GoesLeft>
Seen partitionInOrder(std::span<T>& items, std::span<T>& spare, size_t leftSize, const GoesLeft& goesLeft) {
    if (items.size() > kParallelPass) {
        const Seen seen = partitionInOrderParallel<Seen>(items, spare, leftSize, goesLeft);
        std::swap(items, spare);
        return seen;
    }
    const Seen seen = distribute<Seen, T>(items, goesLeft, items.data(), spare.data());
    std::copy_n(spare.data(), items.size() - leftSize, items.data() + leftSize);
    return seen;
}

/// For partitionInOrder(): the boxes of the centroids of both sides.
struct CentroidBoxes {
    Box4 left;
    Box4 right;

    void add(const PrimitiveRef& ref, int isLeft) {
        const Float4 centroid = ref.centroid2();
        const Float4 ifLeft = nanWhere(splat(isLeft - 1), centroid);
        const Float4 ifRight = nanWhere(splat(-isLeft), centroid);
        left.grow(ifLeft, ifLeft);
        right.grow(ifRight, ifRight);
    }
    void add(const CentroidBoxes& other) {
        left.grow(other.left);
        right.grow(other.right);
    }
};

/// The range as two, its first `leftSize` primitives and the others; boxes are left to the caller.
Sides<PrimitiveRange> cut(const PrimitiveRange& range, size_t leftSize);

/// As two, by goesLeft(ref), which `leftSize` of them do; `bounds` of both are left to the caller.
template <class GoesLeft>
Sides<PrimitiveRange> partition(PrimitiveRange range, size_t leftSize, const GoesLeft& goesLeft) {
    const auto centroids2 = partitionInOrder<CentroidBoxes>(range.refs, range.spare, leftSize, goesLeft);
    Sides<PrimitiveRange> sides = cut(range, leftSize);
    sides.left.centroids2 = centroids2.left;
    sides.right.centroids2 = centroids2.right;
    return sides;
}

/// Fills in `bounds` and `centroids2`.
void computeBoxes(PrimitiveRange& range);

}  // namespace raylab
