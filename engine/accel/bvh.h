#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/accel/aabb.h"

namespace raylab {

/// A node of the binary tree. A leaf has count > 0 and holds the primitives order[first .. first + count); an inner
/// node has count == 0 and its children are nodes[left] and nodes[left + 1].
struct BvhNode {
    Aabb bounds;
    uint32_t left = 0;
    uint32_t first = 0;
    uint32_t count = 0;

    bool isLeaf() const { return count != 0; }
};

/// What every builder produces and every GPU layout is flattened from.
/// nodes[0] is the root; the two children of a node are neighbours, followed by everything below the left child and
/// then everything below the right one (so children come after their parents). No primitives: no nodes.
struct Bvh {
    std::vector<BvhNode> nodes;
    /// Primitive ids in leaf order. Each usable primitive is there once; only the builders `spatial` and `auto` list
    /// some again, in other leaves, with a part of the primitive in the box of each: order.size() less the usable ones are
    /// duplicates.
    std::vector<uint32_t> order;
    uint32_t depth = 0;  ///< edges between the root and the deepest leaf
    size_t skipped = 0;  ///< primitives with an empty, non-finite or oversized box: not in `order`
};

/// Limits that the layouts and the traversal kernels rely on.
constexpr int kMaxLeafSize = 16;  ///< a child reference has four bits for count - 1
constexpr int kMaxBvhDepth = 62;  ///< a traversal stack of 64 never overflows
constexpr int kMaxBvhBins = 32;
constexpr float kMaxSpatialBudget = 4.0f;
constexpr int kMaxSearchRadius = 64;
constexpr size_t kMaxBvhPrimitives = size_t{1} << 27;  ///< a child reference has 27 bits for the first one

struct BvhConfig {
    /// Candidate planes + 1 an axis, 2 .. kMaxBvhBins. SAH on Sponza and on the dragon: 77.7 and 49.1 with 16 bins, 75.7 and
    /// 48.8 with 32, at no difference in time that two threads show; Embree's medium build has 75.4 and 49.1.
    int bins = 32;
    int maxLeafSize = 4;            ///< primitives in a leaf at most, 1 .. kMaxLeafSize; SAH often stops earlier
    float traversalCost = 1.0f;     ///< of one inner node, in any unit
    float intersectionCost = 1.0f;  ///< of one primitive, in the same unit
    int maxDepth = 40;              ///< edges from the root to the deepest leaf, 1 .. kMaxBvhDepth
    /// Of `spatial`: duplicate references at most, as a part of the triangles, 0 .. kMaxSpatialBudget.
    float spatialBudget = 0.25f;
    /// Of `spatial`: planes through triangles are tried where the boxes of the best division of whole ones overlap by
    /// more than this part of the root's area (Stich et al. 2009, section 4.3: alpha, there 1e-5, which takes a third
    /// longer to build for a SAH at most 2 % lower: docs/benchmarks/2026-11-23-traversal.md).
    float spatialOverlap = 1e-4f;
    /// Of `linear`: how far along the curve a cluster looks for its nearest neighbour, 1 .. kMaxSearchRadius. On the
    /// dragon 4 give SAH 51.5 and 16 give 51.4; the build with 16 takes a quarter longer.
    int searchRadius = 4;
};

}  // namespace raylab
