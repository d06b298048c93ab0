#pragma once

#include "engine/accel/build_input.h"
#include "engine/accel/bvh.h"

namespace raylab {

/// Top-down build with spatial splits: Stich, Friedrich and Dietrich, "Spatial Splits in Bounding Volume Hierarchies",
/// HPG 2009. A node is divided as by buildBinned() or, where the boxes of that would overlap (section 4.3), by a plane
/// through its triangles if that is cheaper; a triangle on both sides is clipped exactly (section 4.1) and listed in
/// both unless it is cheaper in one (section 4.4). Leaf boxes hold the clipped parts only.
///
/// Duplicates are at most config.spatialBudget times the triangles. Each node owns its part of what is left and divides
/// it between its sides by how much area the boxes of their primitives have, so that the result is bit-identical
/// for any number of threads; a plane that needs more than the node has is not taken. Depth as of buildBinned().
/// Without triangles, or a budget, it is buildBinned(). Throws as that does, and Error where there are triangles but
/// not as many as bounds.
Bvh buildSpatial(const BuildInput& input, const BvhConfig& config = {}, const BuildControl& control = {});

}  // namespace raylab
