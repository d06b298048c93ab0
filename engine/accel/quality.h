#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

#include "engine/accel/bvh.h"

namespace raylab {

/// Half of the surface area of a box that is not empty, in double precision.
double halfAreaDouble(const Aabb& box);
/// The same of the intersection of two boxes; 0 where they are apart or meet in a face only.
double sharedHalfArea(const Aabb& a, const Aabb& b);

struct BvhQuality {
    /// Expected cost of a long ray that crosses the root (Goldsmith and Salmon 1987; Aila et al. 2013, equation 1):
    /// the areas of inner nodes times traversalCost and of leaves times count times intersectionCost, over the root's
    /// area. 0 for an empty tree and for a root without area.
    double sah = 0.0;
    /// How much the boxes of siblings overlap: the areas of the intersections of the two boxes below each inner node,
    /// over the areas of the inner nodes. That is the part of a node's area, on average over the inner nodes weighted
    /// by area, in which both children are hit. Boxes that meet in a face only do not overlap. 0 without inner nodes of
    /// any area.
    double siblingOverlap = 0.0;
    double epo = std::numeric_limits<double>::quiet_NaN();  ///< see measureEpo(); NaN: not measured
    int depth = 0;                                          ///< edges between the root and the deepest leaf
    size_t nodes = 0;                                       ///< leaves included
    size_t leaves = 0;
    double meanLeafSize = 0.0;
    std::vector<uint32_t> leafSizeHistogram;  ///< [i]: leaves of i primitives
    std::vector<uint32_t> depthHistogram;     ///< [i]: leaves at depth i
};

/// Everything but `epo`, in one pass over the nodes. The costs are the config's, whatever the tree was built with.
BvhQuality measureQuality(const Bvh& bvh, const BvhConfig& config = {});

/// End-point overlap (Aila, Karras and Laine, "On Quality Metrics of Bounding Volume Hierarchies", HPG 2013, equation
/// 2): the cost of the nodes that a point on the surface lies in although they do not hold that surface, on average
/// over the surface. A node holds a triangle that is listed anywhere below it, and a triangle listed more than once is
/// one surface. Exact: each triangle is clipped, in double precision, against the nodes that it reaches into.
/// Takes seconds for a million triangles, on all threads; the result does not depend on their number. 0 for an empty
/// tree. `positions` and `triangles` are what the tree was built over.
double measureEpo(const Bvh& bvh, std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                  const BvhConfig& config = {});

}  // namespace raylab
