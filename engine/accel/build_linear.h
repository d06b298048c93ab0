#pragma once

#include <span>

#include "engine/accel/build_input.h"
#include "engine/accel/bvh.h"

namespace raylab {

/// Primitives are sorted along a Morton curve, merged into clusters of a few by locally-ordered clustering (Meister and
/// Bittner, "Parallel Locally-Ordered Clustering for Bounding Volume Hierarchy Construction", TVCG 2018: those that are
/// each other's nearest neighbour, among config.searchRadius to either side, by turns; distance is the area of the
/// common box), and the tree above the clusters is built by buildBinned(). Small subtrees become leaves where SAH says
/// so. For trees that are rebuilt while somebody waits; clustering all the way up is slower, and worse on scans.
///
/// In parallel, bit-identical for any number of threads. Turns that merge few clusters (nested boxes sorted by size)
/// merge all neighbours instead, so that there are not many. Subtrees deeper than config.maxDepth allows are built
/// again as halves along the curve. Throws as buildBinned() does.
Bvh buildLinear(std::span<const Aabb> bounds, const BvhConfig& config = {}, const BuildControl& control = {});

}  // namespace raylab
