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
    std::vector<uint32_t> order;  ///< primitive ids in leaf order: each usable primitive exactly once
    uint32_t depth = 0;           ///< edges between the root and the deepest leaf
    size_t skipped = 0;           ///< primitives with an empty, non-finite or oversized box: not in `order`
};

/// Limits that the layouts and the traversal kernels rely on.
constexpr int kMaxLeafSize = 16;  ///< a child reference has four bits for count - 1
constexpr int kMaxBvhDepth = 62;  ///< a traversal stack of 64 never overflows
constexpr int kMaxBvhBins = 32;
constexpr size_t kMaxBvhPrimitives = size_t{1} << 27;  ///< a child reference has 27 bits for the first one

struct BvhConfig {
    /// Candidate planes + 1 an axis, 2 .. kMaxBvhBins. On the dragon 8 bins give SAH 49.9, 16 give 49.1, 32 give 48.8;
    /// on two threads 32 take about a tenth longer than 16, and 8 no less.
    int bins = 16;
    int maxLeafSize = 4;            ///< primitives in a leaf at most, 1 .. kMaxLeafSize; SAH often stops earlier
    float traversalCost = 1.0f;     ///< of one inner node, in any unit
    float intersectionCost = 1.0f;  ///< of one primitive, in the same unit
    int maxDepth = 40;              ///< edges from the root to the deepest leaf, 1 .. kMaxBvhDepth
};

}  // namespace raylab
