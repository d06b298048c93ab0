#pragma once

#include "engine/accel/binned_split.h"
#include "engine/accel/build_clip.h"
#include "engine/accel/build_input.h"

namespace raylab {

constexpr int kLeftSide = 1;
constexpr int kRightSide = 2;

/// A plane through the triangles of a node, and the sides as the bins have them.
struct SpatialSplit {
    float cost = std::numeric_limits<float>::infinity();  ///< as of BinnedSplit
    int axis = -1;                                        ///< -1: there is none
    float plane = 0.0f;
    Box4 left{};
    Box4 right{};
    float leftCount = 0.0f;
    float rightCount = 0.0f;

    /// kLeftSide, kRightSide or both: a reference that the plane cuts goes to one side as a whole where the larger box
    /// there costs less than the one more reference (Stich et al. 2009, section 4.4). Does not depend on the others.
    int sidesOf(const PrimitiveRef& ref) const;
};

/// Both parts of a reference that the plane cuts. Where rounding leaves nothing of the triangle on one side, that part
/// is the box's.
Sides<PrimitiveRef> splitReference(const PrimitiveRef& ref, int axis, float plane, const BuildInput& input);

/// The cheapest of the planes between equal bins over the node's box, on the three axes (Stich et al. 2009, section
/// 4.2); each triangle is clipped to the bins that it reaches into.
SpatialSplit cheapestSpatialSplit(std::span<const PrimitiveRef> refs, const Box4& bounds, int bins,
                                  const BuildInput& input);

}  // namespace raylab
