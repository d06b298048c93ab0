#include "engine/accel/build_spatial.h"

#include <algorithm>
#include <string>

#include "engine/accel/build_binned.h"
#include "engine/accel/build_spatial_split.h"
#include "engine/accel/build_topdown.h"
#include "engine/core/error.h"

namespace raylab {
namespace {

/// References of one node, and its budget: `room` for that many more.
struct SpatialRange {
    std::span<PrimitiveRef> room;   ///< begins with the references
    std::span<PrimitiveRef> spare;  ///< as long, and free to use
    size_t count = 0;
    Box4 bounds;
    Box4 centroids2;

    size_t size() const { return count; }
    size_t budget() const { return room.size() - count; }
    std::span<PrimitiveRef> refs() const { return room.first(count); }
    void appendIds(std::vector<uint32_t>& ids) const { raylab::appendIds(refs(), ids); }

    void growBoxes(const PrimitiveRef& ref) {
        bounds.grow(ref.box());
        centroids2.grow(ref.centroid2(), ref.centroid2());
    }
    void growBoxes(const SpatialRange& other) {
        bounds.grow(other.bounds);
        centroids2.grow(other.centroids2);
    }
};

using SpatialSides = Sides<SpatialRange>;

/// References of one side, and the sum of the areas of their boxes. Sums are taken in the order of chunks.
struct Tally {
    size_t count = 0;
    double area = 0.0;

    void add(const Tally& other) {
        count += other.count;
        area += other.area;
    }
};

using Tallies = Sides<Tally>;

struct SpatialSplitter {
    using Range = SpatialRange;
    const BvhConfig& config;
    const BuildInput& input;
    float leastOverlap;  ///< of the boxes of both sides, in half area, for a spatial split to be tried

    std::optional<SpatialSides> split(const Range& range, int levelsLeft) const {
        if (mustBeLeaf(range.size(), levelsLeft, config)) return std::nullopt;
        return useBins(range.refs(), range.centroids2, config.bins,
                       [&](const Bins& bins, const auto& binOf) { return split(range, levelsLeft, bins, binOf); });
    }

    template <class BinOf>
    std::optional<SpatialSides> split(const Range& range, int levelsLeft, const Bins& bins, const BinOf& binOf) const {
        const float area = range.bounds.halfArea();
        const BinnedSplit object = cheapestSplit(bins);
        if (range.budget() > 0 && overlaps(object, bins)) {
            const SpatialSplit spatial = cheapestSpatialSplit(range.refs(), range.bounds, config.bins, input);
            if (spatial.cost < object.cost && !isLeafCheaper(range.size(), area, spatial.cost, config)) {
                const auto sidesOf = [&](const PrimitiveRef& ref) { return spatial.sidesOf(ref); };
                if (auto sides = divide(range, levelsLeft, spatial, sidesOf)) return sides;
            }
        }
        if (isLeafCheaper(range.size(), area, object.cost, config)) return std::nullopt;
        if (object.axis >= 0) {
            const auto sidesOf = [&](const PrimitiveRef& ref) {
                return binOf(ref, object.axis) < object.bin ? kLeftSide : kRightSide;
            };
            if (auto sides = divide(range, levelsLeft, {}, sidesOf)) return sides;
        }
        const PrimitiveRef* middle = range.refs().data() + orderByMedian(range.refs(), range.centroids2);
        return divide(range, levelsLeft, {},
                      [=](const PrimitiveRef& ref) { return &ref < middle ? kLeftSide : kRightSide; });
    }

    bool overlaps(const BinnedSplit& split, const Bins& bins) const {
        if (split.axis < 0) return true;
        const Box4 left = bins.box(0, split.bin, split.axis);
        const Box4 shared = intersection(left, bins.box(split.bin, bins.size, split.axis));
        return !isEmpty(shared) && shared.halfArea() > leastOverlap;
    }

    /// By sidesOf(ref); what goes to both is split at the plane of `spatial`. Nothing where a side would be empty or
    /// too full for the levels left, or the budget does not suffice.
    template <class SidesOf>
    std::optional<SpatialSides> divide(const Range& range, int levelsLeft, const SpatialSplit& spatial,
                                       const SidesOf& sidesOf) const {
        const std::vector<Tallies> before = tally(range, sidesOf);
        const size_t left = before.back().left.count;
        const size_t right = before.back().right.count;
        if (left == 0 || right == 0 || left + right > range.room.size()) return std::nullopt;
        if (!fits(std::max(left, right), levelsLeft - 1, config)) return std::nullopt;
        return write(range, before, spatial, sidesOf);
    }

    /// What comes before each chunk, and in all of them.
    template <class SidesOf>
    std::vector<Tallies> tally(const Range& range, const SidesOf& sidesOf) const {
        std::vector<Tallies> before(chunkCount(range.size()) + 1);
        forEachChunk(range.size(), [&](size_t chunk, size_t begin, size_t end) {
            Tallies sum;
            for (const PrimitiveRef& ref : range.refs().subspan(begin, end - begin)) {
                const int sides = sidesOf(ref);
                const Tally one{1, static_cast<double>(ref.box().halfArea())};
                if ((sides & kLeftSide) != 0) sum.left.add(one);
                if ((sides & kRightSide) != 0) sum.right.add(one);
            }
            before[chunk + 1] = sum;
        });
        for (size_t i = 1; i < before.size(); ++i) {
            before[i].left.add(before[i - 1].left);
            before[i].right.add(before[i - 1].right);
        }
        return before;
    }

    /// What was spare, as two ranges: the rest of the budget goes to the sides in proportion to their areas.
    SpatialSides divideRoom(const Range& range, const Tallies& all) const {
        const size_t budget = range.room.size() - all.left.count - all.right.count;
        const double area = all.left.area + all.right.area;
        const double share = area > 0.0 ? all.left.area / area : 0.5;
        const size_t leftRoom = all.left.count + static_cast<size_t>(share * static_cast<double>(budget));
        SpatialSides sides;
        sides.left.room = range.spare.first(leftRoom);
        sides.left.spare = range.room.first(leftRoom);
        sides.left.count = all.left.count;
        sides.right.room = range.spare.subspan(leftRoom);
        sides.right.spare = range.room.subspan(leftRoom);
        sides.right.count = all.right.count;
        return sides;
    }

    template <class SidesOf>
    SpatialSides write(const Range& range, const std::vector<Tallies>& before, const SpatialSplit& spatial,
                       const SidesOf& sidesOf) const {
        SpatialSides sides = divideRoom(range, before.back());
        std::vector<SpatialSides> boxes(before.size() - 1);
        forEachChunk(range.size(), [&](size_t chunk, size_t begin, size_t end) {
            PrimitiveRef* left = sides.left.room.data() + before[chunk].left.count;
            PrimitiveRef* right = sides.right.room.data() + before[chunk].right.count;
            for (const PrimitiveRef& ref : range.refs().subspan(begin, end - begin)) {
                const int sidesOfRef = sidesOf(ref);
                Sides<PrimitiveRef> parts{ref, ref};
                if (sidesOfRef == (kLeftSide | kRightSide))
                    parts = splitReference(ref, spatial.axis, spatial.plane, input);
                if ((sidesOfRef & kLeftSide) != 0) boxes[chunk].left.growBoxes(*left++ = parts.left);
                if ((sidesOfRef & kRightSide) != 0) boxes[chunk].right.growBoxes(*right++ = parts.right);
            }
        });
        for (const SpatialSides& chunk : boxes) {
            sides.left.growBoxes(chunk.left);
            sides.right.growBoxes(chunk.right);
        }
        return sides;
    }
};

/// A triangle's parts can be a rounding smaller than what they were parts of.
void tightenInnerNodes(Bvh& bvh) {
    for (size_t i = bvh.nodes.size(); i-- > 0;) {
        BvhNode& node = bvh.nodes[i];
        if (node.isLeaf()) continue;
        node.bounds = bvh.nodes[node.left].bounds;
        node.bounds.grow(bvh.nodes[node.left + 1].bounds);
    }
}

}  // namespace

Bvh buildSpatial(const BuildInput& input, const BvhConfig& config, const BuildControl& control) {
    const size_t size = input.bounds.size();
    checkConfig(config, size);
    if (!input.triangles.empty() && input.triangles.size() != size)
        throw Error("BVH: " + std::to_string(size) + " boxes of " + std::to_string(input.triangles.size()) +
                    " triangles");
    const auto budget = static_cast<size_t>(static_cast<double>(config.spatialBudget) * static_cast<double>(size));
    const size_t room = std::min(budget, kMaxBvhPrimitives - size);
    if (input.triangles.empty() || room == 0) return buildBinned(input.bounds, config, control);
    std::unique_ptr<PrimitiveRef[]> refs;
    const PrimitiveRange usable = collectRefs(input.bounds, refs, room);
    SpatialRange range;
    range.count = usable.size();
    range.room = {refs.get(), range.count + room};
    const auto spare = std::make_unique_for_overwrite<PrimitiveRef[]>(range.room.size());
    range.spare = {spare.get(), range.room.size()};
    range.bounds = usable.bounds;
    range.centroids2 = usable.centroids2;
    const SpatialSplitter splitter{config, input, config.spatialOverlap * range.bounds.halfArea()};
    Bvh bvh = buildTopDown(range, splitter, config, control, range.room.size());
    tightenInnerNodes(bvh);
    bvh.skipped = size - range.count;
    return bvh;
}

}  // namespace raylab
