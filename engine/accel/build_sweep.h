#pragma once

#include <span>

#include "engine/accel/build_input.h"
#include "engine/accel/bvh.h"

namespace raylab {

/// Top-down build by the surface area heuristic over every plane between neighbouring centroids of the three axes,
/// equal ones in the order of their ids: what binning approximates. Sorted once an axis, and kept sorted by stable
/// partition (as Wald and Havran, "On building fast kd-Trees for Ray Tracing, and on doing that in O(N log N)", RT
/// 2006, section 4.3, do for planes), so O(n log n) in all; in parallel, bit-identical for any number of threads. Depth
/// and what it throws as of buildBinned().
Bvh buildSweep(std::span<const Aabb> bounds, const BvhConfig& config = {}, const BuildControl& control = {});

}  // namespace raylab
