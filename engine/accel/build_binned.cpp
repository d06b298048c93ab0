#include "engine/accel/build_binned.h"

#include <algorithm>

#include "engine/accel/binned_split.h"
#include "engine/accel/build_topdown.h"

namespace raylab {
namespace {

template <class BinOf>
Sides<PrimitiveRange> splitAt(const PrimitiveRange& range, const BinnedSplit& split, size_t leftSize, const Bins& bins,
                              const BinOf& binOf) {
    Sides<PrimitiveRange> sides =
        partition(range, leftSize, [&](const PrimitiveRef& ref) { return binOf(ref, split.axis) < split.bin; });
    sides.left.bounds = bins.box(0, split.bin, split.axis);
    sides.right.bounds = bins.box(split.bin, bins.size, split.axis);
    return sides;
}

struct BinnedSplitter {
    using Range = PrimitiveRange;
    const BvhConfig& config;

    std::optional<Sides<Range>> split(const Range& range, int levelsLeft) const {
        if (mustBeLeaf(range.size(), levelsLeft, config)) return std::nullopt;
        return useBins(range.refs, range.centroids2, config.bins,
                       [&](const Bins& bins, const auto& binOf) { return split(range, levelsLeft, bins, binOf); });
    }
    template <class BinOf>
    std::optional<Sides<Range>> split(const Range& range, int levelsLeft, const Bins& bins, const BinOf& binOf) const {
        const size_t size = range.size();
        const BinnedSplit best = cheapestSplit(bins);
        if (isLeafCheaper(size, range.bounds.halfArea(), best.cost, config)) return std::nullopt;
        if (best.axis < 0) return splitAtMedian(range);
        size_t leftSize = 0;
        for (int i = 0; i < best.bin; ++i) leftSize += static_cast<size_t>(bins.counts[i][best.axis]);
        if (!fits(std::max(leftSize, size - leftSize), levelsLeft - 1, config)) return splitAtMedian(range);
        return splitAt(range, best, leftSize, bins, binOf);
    }
};

}  // namespace

Bvh buildBinned(std::span<const Aabb> bounds, const BvhConfig& config, const BuildControl& control) {
    return buildOverRefs(bounds, BinnedSplitter{config}, config, control);
}

}  // namespace raylab
