#pragma once

#include <cstdint>
#include <vector>

#include "engine/accel/bvh.h"
#include "engine/accel/layout_bvh2q.h"
#include "engine/scene/scene.h"
#include "shaders/shared/scene.h"

namespace raylab {

/// One tree over triangles: a mesh below instances, or meshes merged in world space (TreePlan).
struct TriangleTree {
    Bvh bvh;
    Grid grid;
    uint32_t depth = 0;  ///< of the flattened tree
    uint32_t root = 0;   ///< child reference of its first node
    uint32_t firstTriangle = 0;
    uint32_t triangleCount = 0;
    bool merged = false;
    uint32_t mesh = 0;  ///< where not merged
};

/// What the software tracers read: all trees in one array of nodes, triangles in leaf order, instances in leaf order of
/// the upper tree. Without an upper tree the root is the merged tree's.
struct TraceData {
    std::vector<NodeBvh2q> nodes;
    std::vector<shared::TraceTriangle> triangles;
    std::vector<shared::TraceInstance> instances;
    uint32_t root = 0xffffffffu;  ///< child reference; kEndOfWalk where there is nothing to hit
    Grid grid{};                  ///< of the root's tree
    uint32_t stackEntries = 2;    ///< that the deepest walk can fill
    std::vector<TriangleTree> trees;
    Bvh upper;                    ///< over instances; empty without
    uint32_t upperDepth = 0;
    size_t skippedTriangles = 0;  ///< degenerate or not finite: no ray can hit them
};

/// Builds all trees. Throws Error where the scene has more triangles than child references can address (2^27).
TraceData buildTraceData(const Scene& scene, const BvhConfig& config);

}  // namespace raylab
