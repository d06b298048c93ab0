#pragma once

#include <span>

#include "engine/accel/build_input.h"
#include "engine/accel/bvh.h"

namespace raylab {

// Splits that do not look at areas: fast, and what the others are measured against. Both divide a node until it holds
// config.maxLeafSize primitives or fewer, in parallel, with the same result for any number of threads, never deeper
// than config.maxDepth; both throw as buildBinned() does.

/// A node is split in the middle of the longest axis of the box of its centroids; at the median where one side would
/// be empty or too full for the levels left.
Bvh buildMidpoint(std::span<const Aabb> bounds, const BvhConfig& config = {}, const BuildControl& control = {});

/// A node is split into halves of equal size along the longest axis of the box of its centroids, equal centroids by id:
/// the most balanced tree. Above the subtrees of one thread the selection is not shared between threads.
Bvh buildMedian(std::span<const Aabb> bounds, const BvhConfig& config = {}, const BuildControl& control = {});

}  // namespace raylab
