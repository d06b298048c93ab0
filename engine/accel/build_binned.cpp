#include "engine/accel/build_binned.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "engine/accel/binned_split.h"
#include "engine/core/error.h"

namespace raylab {
namespace {

// Neither constant changes the result: only who computes it.
constexpr size_t kParallelPass = size_t{1}
                                 << 16;       // above: binning and partition of one node are shared between threads
constexpr size_t kSubtree = size_t{1} << 12;  // up to: one thread builds everything below, into nodes of its own
constexpr size_t kChunk = size_t{1} << 13;

/// Primitives of one node. `spare` is as long as `refs` and free to use.
struct Range {
    std::span<PrimitiveRef> refs;
    std::span<PrimitiveRef> spare;
    uint32_t first = 0;  ///< of refs[0] in Bvh::order
    Box4 bounds;
    Box4 centroids2;
};

struct Halves {
    Range left;
    Range right;
};

/// What one thread builds: nodes[0] the root, in the order that Bvh documents.
struct Subtree {
    std::vector<BvhNode> nodes;
    uint32_t depth = 0;
};

/// A node above the subtrees that one thread builds; without children it holds such a subtree.
struct TopNode {
    Box4 bounds;
    std::unique_ptr<TopNode> left;
    std::unique_ptr<TopNode> right;
    Subtree subtree;
};

size_t chunkCount(size_t size) { return (size + kChunk - 1) / kChunk; }

template <class Body>
void forEachChunk(size_t size, const Body& body) {
    tbb::parallel_for(size_t{0}, chunkCount(size),
                      [&](size_t chunk) { body(chunk, chunk * kChunk, std::min(size, (chunk + 1) * kChunk)); });
}

void addToBins(std::span<const PrimitiveRef> refs, const BinMapping& mapping, Bins& bins) {
    for (const PrimitiveRef& ref : refs) {
        const Int4 bin = mapping.binsOf(ref);
        for (int axis = 0; axis < 3; ++axis) bins.add(bin[axis], axis, {ref.lo, ref.hi}, 1);
    }
}

Bins fillBins(std::span<const PrimitiveRef> refs, const BinMapping& mapping, int size) {
    Bins bins(size);
    addToBins(refs, mapping, bins);
    return bins;
}

Bins fillBinsParallel(std::span<const PrimitiveRef> refs, const BinMapping& mapping, int size) {
    return tbb::parallel_reduce(
        tbb::blocked_range<size_t>(0, refs.size(), kChunk), Bins(size),
        [&](const tbb::blocked_range<size_t>& range, Bins bins) {
            addToBins(refs.subspan(range.begin(), range.size()), mapping, bins);
            return bins;
        },
        [](Bins a, const Bins& b) {
            a.add(b);
            return a;
        });
}

/// Cuts a range in two after its first `leftSize` primitives. Boxes are left to the caller.
Halves cut(const Range& range, size_t leftSize) {
    Halves halves;
    halves.left.refs = range.refs.first(leftSize);
    halves.left.spare = range.spare.first(leftSize);
    halves.left.first = range.first;
    halves.right.refs = range.refs.subspan(leftSize);
    halves.right.spare = range.spare.subspan(leftSize);
    halves.right.first = range.first + static_cast<uint32_t>(leftSize);
    return halves;
}

/// Moves the primitives of a stretch to `left` and `right`, in order and without branches, and grows the boxes of the
/// centroids of both sides. `left` may be the stretch itself.
template <class GoesLeft>
void distribute(std::span<const PrimitiveRef> refs, const GoesLeft& goesLeft, PrimitiveRef* left, PrimitiveRef* right,
                Box4& leftCentroids2, Box4& rightCentroids2) {
    Box4 leftBox;
    Box4 rightBox;
    PrimitiveRef* next[2] = {right, left};  // a table instead of a condition: sides are as good as random
    for (const PrimitiveRef& ref : refs) {
        const Float4 centroid = ref.centroid2();
        const int isLeft = goesLeft(ref) ? 1 : 0;
        *next[isLeft] = ref;
        ++next[isLeft];
        const Float4 ifLeft = nanWhere(splat(isLeft - 1), centroid);
        const Float4 ifRight = nanWhere(splat(-isLeft), centroid);
        leftBox.grow(ifLeft, ifLeft);
        rightBox.grow(ifRight, ifRight);
    }
    leftCentroids2 = leftBox;
    rightCentroids2 = rightBox;
}

template <class GoesLeft>
Halves partition(const Range& range, size_t leftSize, const GoesLeft& goesLeft) {
    Halves halves = cut(range, leftSize);
    distribute(range.refs, goesLeft, range.refs.data(), range.spare.data(), halves.left.centroids2,
               halves.right.centroids2);
    std::copy_n(range.spare.data(), halves.right.refs.size(), halves.right.refs.data());
    return halves;
}

/// As partition(), chunks in parallel: the halves end up in what was spare.
template <class GoesLeft>
Halves partitionParallel(const Range& range, size_t leftSize, const GoesLeft& goesLeft) {
    const size_t size = range.refs.size();
    std::vector<size_t> leftBefore(chunkCount(size) + 1, 0);
    forEachChunk(size, [&](size_t chunk, size_t begin, size_t end) {
        leftBefore[chunk + 1] =
            static_cast<size_t>(std::count_if(range.refs.begin() + begin, range.refs.begin() + end, goesLeft));
    });
    std::partial_sum(leftBefore.begin(), leftBefore.end(), leftBefore.begin());
    std::vector<std::pair<Box4, Box4>> centroids2(chunkCount(size));
    forEachChunk(size, [&](size_t chunk, size_t begin, size_t end) {
        PrimitiveRef* left = range.spare.data() + leftBefore[chunk];
        PrimitiveRef* right = range.spare.data() + leftSize + (begin - leftBefore[chunk]);
        distribute(range.refs.subspan(begin, end - begin), goesLeft, left, right, centroids2[chunk].first,
                   centroids2[chunk].second);
    });
    Halves halves = cut({range.spare, range.refs, range.first, {}, {}}, leftSize);
    for (const auto& [left, right] : centroids2) {
        halves.left.centroids2.grow(left);
        halves.right.centroids2.grow(right);
    }
    return halves;
}

template <class BinOf>
Halves splitAt(const Range& range, const BinnedSplit& split, size_t leftSize, const Bins& bins, const BinOf& binOf) {
    const auto goesLeft = [&](const PrimitiveRef& ref) { return binOf(ref, split.axis) < split.bin; };
    Halves halves = range.refs.size() > kParallelPass ? partitionParallel(range, leftSize, goesLeft)
                                                      : partition(range, leftSize, goesLeft);
    for (int i = 0; i < bins.size; ++i)
        (i < split.bin ? halves.left : halves.right).bounds.grow(bins.box(i, split.axis));
    return halves;
}

void computeBoxes(Range& range) {
    for (const PrimitiveRef& ref : range.refs) {
        range.bounds.grow(ref.lo, ref.hi);
        range.centroids2.grow(ref.centroid2(), ref.centroid2());
    }
}

/// Halves of equal size along the axis on which the centroids spread most: bounds the depth on any input.
Halves splitAtMedian(const Range& range) {
    const Float4 spread = range.centroids2.hi - range.centroids2.lo;
    const int axis = spread[0] >= spread[1] && spread[0] >= spread[2] ? 0 : spread[1] >= spread[2] ? 1 : 2;
    const size_t leftSize = range.refs.size() / 2;
    std::nth_element(range.refs.begin(), range.refs.begin() + leftSize, range.refs.end(),
                     [axis](const PrimitiveRef& a, const PrimitiveRef& b) {
                         return std::pair(a.centroid2(axis), a.id()) < std::pair(b.centroid2(axis), b.id());
                     });
    Halves halves = cut(range, leftSize);
    computeBoxes(halves.left);
    computeBoxes(halves.right);
    return halves;
}

/// Whether a subtree of `levels` levels below its root can hold that many primitives.
bool fits(size_t size, int levels, const BvhConfig& config) {
    return size <= static_cast<size_t>(config.maxLeafSize) << std::min(levels, 40);
}

bool mayBeLeaf(size_t size, const BvhConfig& config) { return size <= static_cast<size_t>(config.maxLeafSize); }

/// The two sides of a node, or nothing where it is to be a leaf. `levelsLeft`: edges that may follow below this node.
template <class BinOf>
std::optional<Halves> split(const Range& range, int levelsLeft, const BvhConfig& config, const Bins& bins,
                            const BinOf& binOf) {
    const size_t size = range.refs.size();
    const BinnedSplit best = cheapestSplit(bins);
    const float area = range.bounds.halfArea();
    const float splitCost = config.traversalCost * area + config.intersectionCost * best.cost;
    const float leafCost = config.intersectionCost * area * static_cast<float>(size);
    if (mayBeLeaf(size, config) && !(splitCost < leafCost)) return std::nullopt;
    if (best.axis < 0) return splitAtMedian(range);
    size_t leftSize = 0;
    for (int i = 0; i < best.bin; ++i) leftSize += static_cast<size_t>(bins.counts[i][best.axis]);
    if (!fits(std::max(leftSize, size - leftSize), levelsLeft - 1, config)) return splitAtMedian(range);
    return splitAt(range, best, leftSize, bins, binOf);
}

std::optional<Halves> split(const Range& range, int levelsLeft, const BvhConfig& config) {
    const size_t size = range.refs.size();
    if (size == 1 || (mayBeLeaf(size, config) && levelsLeft == 0)) return std::nullopt;
    if (size <= kExactSweep) {
        const Ranks ranks(range.refs);
        return split(range, levelsLeft, config, Bins(ranks), ranks);
    }
    const BinMapping mapping(range.centroids2, config.bins);
    const Bins bins = size > kParallelPass ? fillBinsParallel(range.refs, mapping, config.bins)
                                           : fillBins(range.refs, mapping, config.bins);
    return split(range, levelsLeft, config, bins, mapping);
}

Aabb toAabb(const Box4& box) { return {toVec3(box.lo), toVec3(box.hi)}; }

/// Fills in nodes[slot] and appends everything below it.
void buildBelow(const Range& range, size_t slot, int level, const BvhConfig& config, Subtree& subtree) {
    subtree.nodes[slot].bounds = toAabb(range.bounds);
    const std::optional<Halves> halves = split(range, config.maxDepth - level, config);
    if (!halves) {
        subtree.nodes[slot].first = range.first;
        subtree.nodes[slot].count = static_cast<uint32_t>(range.refs.size());
        subtree.depth = std::max(subtree.depth, static_cast<uint32_t>(level));
        return;
    }
    const size_t left = subtree.nodes.size();
    subtree.nodes[slot].left = static_cast<uint32_t>(left);
    subtree.nodes.resize(left + 2);
    buildBelow(halves->left, left, level + 1, config, subtree);
    buildBelow(halves->right, left + 1, level + 1, config, subtree);
}

std::unique_ptr<TopNode> buildTop(const Range& range, int level, const BvhConfig& config, std::span<uint32_t> order) {
    auto top = std::make_unique<TopNode>();
    top->bounds = range.bounds;
    if (range.refs.size() <= kSubtree) {
        top->subtree.nodes.reserve(range.refs.size());
        top->subtree.nodes.emplace_back();
        buildBelow(range, 0, level, config, top->subtree);
        for (size_t i = 0; i < range.refs.size(); ++i) order[range.first + i] = range.refs[i].id();
        return top;
    }
    const std::optional<Halves> halves = split(range, config.maxDepth - level, config);
    tbb::parallel_invoke([&] { top->left = buildTop(halves->left, level + 1, config, order); },
                         [&] { top->right = buildTop(halves->right, level + 1, config, order); });
    return top;
}

/// Where a subtree goes in Bvh::nodes: its root into `slot`, the others from `below` on.
struct Placement {
    const Subtree* subtree;
    size_t slot;
    size_t below;
};

size_t countNodes(const TopNode& top) {
    return top.left ? 1 + countNodes(*top.left) + countNodes(*top.right) : top.subtree.nodes.size();
}

/// Writes the top nodes and lists the subtrees; `next` is the first free node. Returns the next free one after that.
size_t place(const TopNode& top, size_t slot, size_t next, std::vector<BvhNode>& nodes, std::vector<Placement>& list) {
    if (!top.left) {
        list.push_back({&top.subtree, slot, next});
        return next + top.subtree.nodes.size() - 1;
    }
    nodes[slot].bounds = toAabb(top.bounds);
    nodes[slot].left = static_cast<uint32_t>(next);
    const size_t afterLeft = place(*top.left, next, next + 2, nodes, list);
    return place(*top.right, next + 1, afterLeft, nodes, list);
}

void copySubtree(const Placement& placement, std::vector<BvhNode>& nodes) {
    const std::vector<BvhNode>& source = placement.subtree->nodes;
    const auto shift = static_cast<uint32_t>(placement.below - 1);
    for (size_t i = 0; i < source.size(); ++i) {
        BvhNode& node = nodes[i == 0 ? placement.slot : placement.below + i - 1];
        node = source[i];
        if (!node.isLeaf()) node.left += shift;
    }
}

void joinSubtrees(const TopNode& root, Bvh& bvh) {
    bvh.nodes.resize(countNodes(root));
    std::vector<Placement> list;
    place(root, 0, 1, bvh.nodes, list);
    for (const Placement& placement : list) bvh.depth = std::max(bvh.depth, placement.subtree->depth);
    tbb::parallel_for(size_t{0}, list.size(), [&](size_t i) { copySubtree(list[i], bvh.nodes); });
}

/// The usable primitives, in order, with the boxes around them. Fills in all of the range but `spare`.
Range collectRefs(std::span<const Aabb> bounds, std::unique_ptr<PrimitiveRef[]>& refs) {
    std::vector<size_t> before(chunkCount(bounds.size()) + 1, 0);
    forEachChunk(bounds.size(), [&](size_t chunk, size_t begin, size_t end) {
        before[chunk + 1] = static_cast<size_t>(
            std::count_if(bounds.begin() + begin, bounds.begin() + end, [](const Aabb& box) { return box.usable(); }));
    });
    std::partial_sum(before.begin(), before.end(), before.begin());
    refs = std::make_unique_for_overwrite<PrimitiveRef[]>(before.back());
    std::vector<Range> chunks(chunkCount(bounds.size()));
    forEachChunk(bounds.size(), [&](size_t chunk, size_t begin, size_t end) {
        PrimitiveRef* next = refs.get() + before[chunk];
        for (size_t i = begin; i < end; ++i)
            if (bounds[i].usable()) *next++ = PrimitiveRef(bounds[i], static_cast<uint32_t>(i));
        chunks[chunk].refs = {refs.get() + before[chunk], next};
        computeBoxes(chunks[chunk]);
    });
    Range range;
    range.refs = {refs.get(), before.back()};
    for (const Range& chunk : chunks) {
        range.bounds.grow(chunk.bounds);
        range.centroids2.grow(chunk.centroids2);
    }
    return range;
}

void check(const BvhConfig& config, size_t primitives) {
    const auto require = [](bool good, const std::string& message) {
        if (!good) throw Error("BVH: " + message);
    };
    require(config.bins >= 2 && config.bins <= kMaxBvhBins, "bins is to be 2 to " + std::to_string(kMaxBvhBins));
    require(config.maxLeafSize >= 1 && config.maxLeafSize <= kMaxLeafSize,
            "maxLeafSize is to be 1 to " + std::to_string(kMaxLeafSize));
    require(config.maxDepth >= 1 && config.maxDepth <= kMaxBvhDepth,
            "maxDepth is to be 1 to " + std::to_string(kMaxBvhDepth));
    require(config.traversalCost >= 0.0f && config.intersectionCost > 0.0f, "costs are to be positive");
    require(primitives <= kMaxBvhPrimitives, std::to_string(primitives) +
                                                 " primitives are too many for one tree, at most " +
                                                 std::to_string(kMaxBvhPrimitives) + "; split the mesh");
    require(fits(primitives, config.maxDepth, config),
            std::to_string(primitives) + " primitives do not fit into leaves of " + std::to_string(config.maxLeafSize) +
                " at depth " + std::to_string(config.maxDepth) + "; raise either");
}

}  // namespace

Bvh buildBinned(std::span<const Aabb> bounds, const BvhConfig& config) {
    check(config, bounds.size());
    std::unique_ptr<PrimitiveRef[]> refs;
    Range range = collectRefs(bounds, refs);
    const size_t size = range.refs.size();
    Bvh bvh;
    bvh.skipped = bounds.size() - size;
    if (size == 0) return bvh;
    const auto spare = std::make_unique_for_overwrite<PrimitiveRef[]>(size);
    range.spare = {spare.get(), size};
    bvh.order.resize(size);
    const std::unique_ptr<TopNode> root = buildTop(range, 0, config, bvh.order);
    joinSubtrees(*root, bvh);
    return bvh;
}

}  // namespace raylab
