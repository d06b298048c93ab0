#include "engine/accel/build_range.h"

#include <algorithm>
#include <string>

#include "engine/core/error.h"

namespace raylab {
namespace {

struct RangeBoxes {
    std::span<const PrimitiveRef> refs;
    Box4 bounds{};
    Box4 centroids2{};

    void add(size_t begin, size_t end) {
        for (const PrimitiveRef& ref : refs.subspan(begin, end - begin)) {
            bounds.grow(ref.box());
            centroids2.grow(ref.centroid2(), ref.centroid2());
        }
    }
    void add(const RangeBoxes& other) {
        bounds.grow(other.bounds);
        centroids2.grow(other.centroids2);
    }
};

}  // namespace

void checkConfig(const BvhConfig& config, size_t primitives) {
    const auto require = [](bool good, const std::string& message) {
        if (!good) throw Error("BVH: " + message);
    };
    require(config.bins >= 2 && config.bins <= kMaxBvhBins, "bins is to be 2 to " + std::to_string(kMaxBvhBins));
    require(config.maxLeafSize >= 1 && config.maxLeafSize <= kMaxLeafSize,
            "maxLeafSize is to be 1 to " + std::to_string(kMaxLeafSize));
    require(config.maxDepth >= 1 && config.maxDepth <= kMaxBvhDepth,
            "maxDepth is to be 1 to " + std::to_string(kMaxBvhDepth));
    require(config.traversalCost >= 0.0f && config.intersectionCost > 0.0f, "costs are to be positive");
    require(config.spatialBudget >= 0.0f && config.spatialBudget <= kMaxSpatialBudget,
            "spatialBudget is to be 0 to " + std::to_string(kMaxSpatialBudget));
    require(config.spatialOverlap >= 0.0f, "spatialOverlap is to be 0 or more");
    require(config.searchRadius >= 1 && config.searchRadius <= kMaxSearchRadius,
            "searchRadius is to be 1 to " + std::to_string(kMaxSearchRadius));
    require(primitives <= kMaxBvhPrimitives, std::to_string(primitives) +
                                                 " primitives are too many for one tree, at most " +
                                                 std::to_string(kMaxBvhPrimitives) + "; split the mesh");
    require(fits(primitives, config.maxDepth, config),
            std::to_string(primitives) + " primitives do not fit into leaves of " + std::to_string(config.maxLeafSize) +
                " at depth " + std::to_string(config.maxDepth) + "; raise either");
}

PrimitiveRange collectRefs(std::span<const Aabb> bounds, std::unique_ptr<PrimitiveRef[]>& refs, size_t room) {
    std::vector<size_t> before(chunkCount(bounds.size()) + 1, 0);
    forEachChunk(bounds.size(), [&](size_t chunk, size_t begin, size_t end) {
        before[chunk + 1] = static_cast<size_t>(
            std::count_if(bounds.begin() + begin, bounds.begin() + end, [](const Aabb& box) { return box.usable(); }));
    });
    std::partial_sum(before.begin(), before.end(), before.begin());
    refs = std::make_unique_for_overwrite<PrimitiveRef[]>(before.back() + room);
    std::vector<RangeBoxes> chunks(chunkCount(bounds.size()));
    forEachChunk(bounds.size(), [&](size_t chunk, size_t begin, size_t end) {
        PrimitiveRef* next = refs.get() + before[chunk];
        for (size_t i = begin; i < end; ++i)
            if (bounds[i].usable()) *next++ = PrimitiveRef(bounds[i], static_cast<uint32_t>(i));
        chunks[chunk].refs = {refs.get() + before[chunk], next};
        chunks[chunk].add(0, chunks[chunk].refs.size());
    });
    PrimitiveRange range;
    range.refs = {refs.get(), before.back()};
    for (const RangeBoxes& chunk : chunks) {
        range.bounds.grow(chunk.bounds);
        range.centroids2.grow(chunk.centroids2);
    }
    return range;
}

void appendIds(std::span<const PrimitiveRef> refs, std::vector<uint32_t>& ids) {
    for (const PrimitiveRef& ref : refs) ids.push_back(ref.id());
}

Sides<PrimitiveRange> cut(const PrimitiveRange& range, size_t leftSize) {
    Sides<PrimitiveRange> sides;
    sides.left.refs = range.refs.first(leftSize);
    sides.left.spare = range.spare.first(leftSize);
    sides.right.refs = range.refs.subspan(leftSize);
    sides.right.spare = range.spare.subspan(leftSize);
    return sides;
}

void computeBoxes(PrimitiveRange& range) {
    RangeBoxes boxes{range.refs};
    if (range.size() > kParallelPass)
        boxes = parallelSum(range.size(), boxes);
    else
        boxes.add(0, range.size());
    range.bounds = boxes.bounds;
    range.centroids2 = boxes.centroids2;
}

size_t orderByMedian(std::span<PrimitiveRef> refs, const Box4& centroids2) {
    const int axis = longestAxis(centroids2);
    const size_t leftSize = refs.size() / 2;
    std::nth_element(refs.begin(), refs.begin() + leftSize, refs.end(),
                     [axis](const PrimitiveRef& a, const PrimitiveRef& b) {
                         return std::pair(a.centroid2(axis), a.id()) < std::pair(b.centroid2(axis), b.id());
                     });
    return leftSize;
}

Sides<PrimitiveRange> splitAtMedian(const PrimitiveRange& range) {
    Sides<PrimitiveRange> sides = cut(range, orderByMedian(range.refs, range.centroids2));
    computeBoxes(sides.left);
    computeBoxes(sides.right);
    return sides;
}

}  // namespace raylab
