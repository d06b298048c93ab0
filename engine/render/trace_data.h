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

/// Whether meshes are merged in world space as far as the TreePlan allows, or each has a tree of its own.
enum class Trees { merged, mesh };

/// How the trees of a software traversal are built and laid out.
struct TraceConfig {
    std::string builder = std::string(kDefaultBuilder);  ///< of builders(); instances are always binned
    std::string layout = "bvh4b";        ///< of layouts(); empty: no tree at all, for who walks none of ours
    std::string triangle = "watertight"; ///< of triangleTests()
    bool paddedSlab = true;              ///< the slab test allows for rounding
    BvhConfig bvh;                       ///< maxLeafSize is lowered to what the layout holds
    int reinsertionPasses = 0;           ///< of optimise()
    size_t flattenLimit = TreePlanConfig{}.flattenLimit;
    Trees trees = Trees::merged;
    bool cache = false;                  ///< look for trees in the cache on disk, and leave them there
};

/// One tree over triangles and quadrics: a mesh below instances, or meshes merged in world space (TreePlan).
struct PrimitiveTree {
    Bvh bvh;                    ///< its order alone where there is no layout: that of the primitives
    Aabb bounds;
    Grid grid;                  ///< bvh2q only
    uint32_t root = 0;          ///< reference that a walk of it starts with
    uint32_t stackEntries = 0;  ///< that a walk of it can fill
    uint32_t firstSlot = 0;
    uint32_t slotCount = 0;
    uint32_t firstQuadric = 0;  ///< among the TraceQuadrics
    bool merged = false;
    uint32_t mesh = 0;  ///< where not merged
};

/// What tracers read: all trees in one array, primitives in the order of the leaves' slots, instances in that of the upper
/// tree's. Without an upper tree the root is the merged tree's.
struct TraceData {
    std::vector<glm::uvec4> nodes;                 ///< words of the layout; with the triangles in it where that is a layout of blocks
    std::vector<shared::TraceTriangle> triangles;  ///< a slot each; with their vertices, or naming a quadric
    std::vector<shared::TraceQuadric> quadrics;
    std::vector<Aabb> quadricBounds;  ///< of `quadrics`, in the space of their tree
    std::vector<shared::TraceInstance> instances;
    uint32_t root = kEndOfWalk;  ///< reference; kEndOfWalk where there is nothing to hit
    Grid grid{};                 ///< of the root's tree
    uint32_t stackEntries = 2;   ///< that the deepest walk can fill
    size_t nodeCount = 0;
    std::vector<PrimitiveTree> trees;
    Bvh upper;                   ///< over instances; empty without; without a layout halvingOrder() alone
    size_t lowerNodes = 0;       ///< of the trees over primitives; those of the upper tree stand behind them
    /// Index in `trees` of the one whose first slot this is.
    size_t treeAtSlot(uint32_t firstSlot) const;
    size_t skipped = 0;  ///< primitives that are degenerate or not finite: no ray can hit them
};

/// What planTrees() and analyseNeeds() want to know of it.
TreePlanConfig treePlanConfig(const TraceConfig& config);

/// What of a scene has changed since its trees were built; nothing else has.
struct SceneChange {
    bool instances = false;        ///< matrices of instances
    std::vector<uint32_t> meshes;  ///< whose positions are others; the triangles are the same
};

/// Builds all trees. Throws Error where the scene has more triangles than child references can address, and for names that no
/// table holds; Cancelled as buildBvh() does.
TraceData buildTraceData(const Scene& scene, const TraceConfig& config, const BuildControl& control = {});

/// Takes `data`, which was built for the scene by `config`, up to a change: changed meshes keep their trees with new boxes
/// (refit), and the tree over instances alone is built anew. Throws Error unless config.trees is Trees::mesh, which keeps
/// instances apart.
void updateTraceData(TraceData& data, const Scene& scene, const TraceConfig& config, const SceneChange& change);

}  // namespace raylab
