#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/accel/build_input.h"
#include "engine/accel/builders.h"
#include "engine/accel/bvh.h"
#include "engine/accel/layout.h"
#include "engine/scene/needs.h"
#include "engine/scene/scene.h"
#include "shaders/shared/scene.h"

namespace raylab {

/// How the trees of a software traversal are built and laid out.
struct TraceConfig {
    std::string builder = std::string(kDefaultBuilder);  ///< of builders(); instances are always binned
    std::string layout = "bvh4b";        ///< of layouts()
    std::string triangle = "watertight"; ///< of triangleTests()
    BvhConfig bvh;                       ///< maxLeafSize is lowered to what the layout holds
    int reinsertionPasses = 0;           ///< of optimise()
    size_t flattenLimit = TreePlanConfig{}.flattenLimit;
    bool cache = false;                  ///< look for trees in the cache on disk, and leave them there
};

/// One tree over triangles: a mesh below instances, or meshes merged in world space (TreePlan).
struct TriangleTree {
    Bvh bvh;
    Grid grid;                  ///< bvh2q only
    uint32_t root = 0;          ///< reference that a walk of it starts with
    uint32_t stackEntries = 0;  ///< that a walk of it can fill
    uint32_t firstTriangle = 0;
    uint32_t triangleCount = 0;
    bool merged = false;
    uint32_t mesh = 0;  ///< where not merged
};

/// What the software tracers read: all trees in one array, triangles in the order of the leaves' slots, instances in that of
/// the upper tree's. Without an upper tree the root is the merged tree's.
struct TraceData {
    std::vector<glm::uvec4> nodes;                 ///< words of the layout; with the triangles in it where that is a layout of blocks
    std::vector<shared::TraceTriangle> triangles;  ///< with their vertices
    std::vector<shared::TraceInstance> instances;
    uint32_t root = kEndOfWalk;  ///< reference; kEndOfWalk where there is nothing to hit
    Grid grid{};                 ///< of the root's tree
    uint32_t stackEntries = 2;   ///< that the deepest walk can fill
    size_t nodeCount = 0;
    std::vector<TriangleTree> trees;
    Bvh upper;                   ///< over instances; empty without
    size_t skippedTriangles = 0;  ///< degenerate or not finite: no ray can hit them
};

/// What planTrees() and analyseNeeds() want to know of it.
TreePlanConfig treePlanConfig(const TraceConfig& config);

/// Builds all trees. Throws Error where the scene has more triangles than child references can address, and for names that no
/// table holds; Cancelled as buildBvh() does.
TraceData buildTraceData(const Scene& scene, const TraceConfig& config, const BuildControl& control = {});

}  // namespace raylab
