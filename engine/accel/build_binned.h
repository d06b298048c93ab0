#pragma once

#include <span>

#include "engine/accel/build_input.h"
#include "engine/accel/bvh.h"

namespace raylab {

/// Top-down build by the surface area heuristic over binned centroids on all three axes (Wald, "On fast Construction of
/// SAH-based Bounding Volume Hierarchies", RT 2007), in parallel. The result is bit-identical for any number of
/// threads. Never deeper than config.maxDepth: where the levels left would not suffice after the SAH split, and where
/// no plane separates the centroids, a node is split at the median centroid, equal centroids by id. Primitives whose
/// box is not usable() are left out and counted. Throws Error for a config out of its ranges, or one whose maxDepth and
/// maxLeafSize cannot hold the primitives; Cancelled.
Bvh buildBinned(std::span<const Aabb> bounds, const BvhConfig& config = {}, const BuildControl& control = {});

}  // namespace raylab
