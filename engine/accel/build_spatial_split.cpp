#include "engine/accel/build_spatial_split.h"

#include <algorithm>
#include <array>
#include <optional>

namespace raylab {
namespace {

/// The part of a reference's triangle inside its box.
ClippedTriangle clippedTriangle(const PrimitiveRef& ref, const BuildInput& input) {
    const ClippedTriangle whole(input.positions, input.triangles[ref.id()]);
    return clip(whole, input.bounds[ref.id()], toAabb(ref.box()));
}

/// The corners of that, in float; none of a primitive that is no triangle. Most references are whole triangles.
class Outline {
public:
    Outline(const PrimitiveRef& ref, const BuildInput& input) {
        const glm::uvec3& triangle = input.triangles[ref.id()];
        if (triangle == kBoxAlone) return;
        if (toAabb(ref.box()).contains(input.bounds[ref.id()])) {
            for (int i = 0; i < 3; ++i) corners_[size_++] = toFloat4(input.positions[triangle[i]]);
        } else {
            const ClippedTriangle clipped = clippedTriangle(ref, input);
            for (const glm::dvec3& corner : clipped.corners()) corners_[size_++] = toFloat4(glm::vec3(corner));
        }
    }
    std::span<const Float4> corners() const { return {corners_.data(), size_}; }

private:
    std::array<Float4, ClippedTriangle::kMostCorners> corners_;
    size_t size_ = 0;
};

/// Box and counts of the references in each bin of each axis: in `bins` they count where they begin. Boxes are rounded
/// to nearest here: they decide, and do not end up in the tree.
struct SpatialBins {
    std::span<const PrimitiveRef> refs;
    const BuildInput* input;
    BinMapping mapping;
    Float4 width;  ///< of a bin; not finite on an axis without extent
    Bins bins;
    Int4 ends[kMaxBvhBins];

    SpatialBins(std::span<const PrimitiveRef> refs_, const Box4& bounds, int size, const BuildInput& input_)
        : refs(refs_), input(&input_), mapping(bounds, size), width(splat(1.0f) / mapping.scale), bins(size) {
        for (int i = 0; i < size; ++i) ends[i] = splat(0);
    }
    float plane(int bin, int axis) const { return mapping.base[axis] + static_cast<float>(bin) * width[axis]; }

    void add(size_t begin, size_t end) {
        for (const PrimitiveRef& ref : refs.subspan(begin, end - begin)) add(ref);
    }
    void add(const PrimitiveRef& ref) {
        const Int4 first = mapping.binsOf(ref.lo);
        const Int4 last = mapping.binsOf(ref.hi);
        std::optional<Outline> outline;
        for (int axis = 0; axis < 3; ++axis) {
            ++bins.counts[first[axis]][axis];
            ++ends[last[axis]][axis];
            if (first[axis] == last[axis]) {
                bins.grow(first[axis], axis, ref.box());
            } else {
                if (!outline) outline.emplace(ref, *input);
                chop(ref.box(), outline->corners(), axis, first[axis], last[axis]);
            }
        }
    }
    void slice(const Box4& box, int axis, int first, int last) {
        for (int bin = first; bin <= last; ++bin) {
            Box4 part = box;
            if (bin > first) part.lo[axis] = std::clamp(plane(bin, axis), box.lo[axis], box.hi[axis]);
            if (bin < last) part.hi[axis] = std::clamp(plane(bin + 1, axis), box.lo[axis], box.hi[axis]);
            bins.grow(bin, axis, part);
        }
    }
    /// The part of a polygon in a bin is around its corners there and the points where its edges leave the bin.
    void chop(const Box4& box, std::span<const Float4> corners, int axis, int first, int last) {
        if (corners.empty()) {
            slice(box, axis, first, last);
            return;
        }
        const auto grow = [&](int bin, Float4 point) {
            const Float4 inside = minimum(maximum(point, box.lo), box.hi);
            bins.grow(bin, axis, {inside, inside});
        };
        const auto binOf = [&](Float4 corner) { return std::clamp(mapping.binsOf(corner)[axis], first, last); };
        Float4 a = corners.back();
        int binA = binOf(a);
        for (const Float4 b : corners) {
            const int binB = binOf(b);
            grow(binB, b);
            if (binA != binB) {
                const Float4 slope = (b - a) / splat(b[axis] - a[axis]);
                for (int bin = std::min(binA, binB); bin < std::max(binA, binB); ++bin) {
                    Float4 crossing = a + slope * splat(plane(bin + 1, axis) - a[axis]);
                    grow(bin, crossing);
                    grow(bin + 1, crossing);
                }
            }
            a = b;
            binA = binB;
        }
    }
    void add(const SpatialBins& other) {
        bins.add(other.bins);
        for (int i = 0; i < bins.size; ++i) ends[i] += other.ends[i];
    }
};

SpatialSplit cheapestSplit(const SpatialBins& spatial) {
    const BinnedSplit best = cheapestSplit(spatial.bins, spatial.ends);
    SpatialSplit split;
    if (best.axis < 0) return split;
    split.cost = best.cost;
    split.axis = best.axis;
    split.plane = spatial.plane(best.bin, best.axis);
    split.left = spatial.bins.box(0, best.bin, best.axis);
    split.right = spatial.bins.box(best.bin, spatial.bins.size, best.axis);
    for (int i = 0; i < spatial.bins.size; ++i) {
        if (i < best.bin)
            split.leftCount += static_cast<float>(spatial.bins.counts[i][best.axis]);
        else
            split.rightCount += static_cast<float>(spatial.ends[i][best.axis]);
    }
    return split;
}

/// `part` as far as it is inside `half` of the reference's box, or all of that half.
PrimitiveRef partOf(const ClippedTriangle& part, const Box4& half, uint32_t id) {
    const Box4 box = intersection(toBox4(part.bounds()), half);
    return {toAabb(isEmpty(box) ? half : box), id};
}

}  // namespace

int SpatialSplit::sidesOf(const PrimitiveRef& ref) const {
    if (ref.hi[axis] <= plane) return kLeftSide;
    if (ref.lo[axis] >= plane) return kRightSide;
    Box4 grownLeft = left;
    grownLeft.grow(ref.box());
    Box4 grownRight = right;
    grownRight.grow(ref.box());
    const float both = left.halfArea() * leftCount + right.halfArea() * rightCount;
    const float onlyLeft = grownLeft.halfArea() * leftCount + right.halfArea() * (rightCount - 1.0f);
    const float onlyRight = left.halfArea() * (leftCount - 1.0f) + grownRight.halfArea() * rightCount;
    if (both < onlyLeft && both < onlyRight) return kLeftSide | kRightSide;
    return onlyLeft <= onlyRight ? kLeftSide : kRightSide;
}

Sides<PrimitiveRef> splitReference(const PrimitiveRef& ref, int axis, float plane, const BuildInput& input) {
    const ClippedTriangle triangle = clippedTriangle(ref, input);
    Sides<Box4> halves{ref.box(), ref.box()};
    halves.left.hi[axis] = halves.right.lo[axis] = plane;
    const auto at = static_cast<double>(plane);
    return {partOf(clip(triangle, axis, at, -1.0), halves.left, ref.id()),
            partOf(clip(triangle, axis, at, 1.0), halves.right, ref.id())};
}

SpatialSplit cheapestSpatialSplit(std::span<const PrimitiveRef> refs, const Box4& bounds, int bins,
                                  const BuildInput& input) {
    SpatialBins spatial(refs, bounds, bins, input);
    if (refs.size() > kParallelPass) return cheapestSplit(parallelSum(refs.size(), spatial));
    spatial.add(0, refs.size());
    return cheapestSplit(spatial);
}

}  // namespace raylab
