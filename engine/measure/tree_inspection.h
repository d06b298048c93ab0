#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "engine/accel/inspect.h"
#include "engine/accel/quality.h"
#include "engine/render/trace_data.h"

namespace raylab {

constexpr uint32_t kUpperTree = 0xffffffffu;  ///< stands for TraceData::upper where a tree is named by its index

/// A node as one meets it on the way from the root: a tree that several instances show is there several times.
struct TreeNode {
    uint32_t tree = 0;       ///< of TraceData::trees, or kUpperTree
    uint32_t node = 0;       ///< of its Bvh::nodes
    uint32_t placement = 0;  ///< of TreeInspection::placements; 0 in the upper tree

    bool operator==(const TreeNode&) const = default;
};

/// Where a tree over primitives hangs: one for each slot of the upper tree, or a single one without that.
struct TreePlacement {
    uint32_t tree = 0;
    uint32_t instance = 0;   ///< of the scene; kInheritInstance: the tree of merged meshes, whose slots name theirs
    uint32_t rootDepth = 0;  ///< of its root, from the root of all
    Aabb bounds;             ///< in the world: of the leaf of the upper tree that holds it, else its own
    glm::mat4 toWorld{1.0f};
    glm::mat4 toObject{1.0f};
};

/// The binary trees of a scene as the software traversal has them, to be looked at. Layouts widen and pack them, but
/// keep their boxes.
struct TreeInspection {
    TraceConfig config;
    TraceData data;  ///< its nodes' words are not there; slots are in the order of each Bvh::order
    std::vector<TreePlacement> placements;
    std::vector<NodeFacts> upperFacts;
    std::vector<std::vector<NodeFacts>> facts;  ///< of each of data.trees
    double sah = 0.0;                           ///< combinedSah()
    double buildSeconds = 0.0;

    const Bvh& bvh(uint32_t tree) const { return tree == kUpperTree ? data.upper : data.trees[tree].bvh; }
    const std::vector<NodeFacts>& factsOf(uint32_t tree) const { return tree == kUpperTree ? upperFacts : facts[tree]; }
    const BvhNode& node(const TreeNode& at) const { return bvh(at.tree).nodes[at.node]; }
    const NodeFacts& fact(const TreeNode& at) const { return factsOf(at.tree)[at.node]; }
    bool empty() const { return placements.empty(); }
    /// Where every walk begins. Not for an empty inspection.
    TreeNode root() const;
    /// Edges from the root of all; the step from a leaf of the upper tree into the tree of an instance is one.
    uint32_t depth(const TreeNode& at) const;
    /// Holds primitives: leaves of the upper tree hold trees and are none.
    bool isLeaf(const TreeNode& at) const { return at.tree != kUpperTree && node(at).isLeaf(); }
    /// The two nodes below; below a leaf of the upper tree the roots of what it holds. Nothing below a leaf.
    std::vector<TreeNode> children(const TreeNode& at) const;
    glm::mat4 toWorld(const TreeNode& at) const;
    /// Index of the scene's instance; kInheritInstance in the upper tree and in that of merged meshes.
    uint32_t instance(const TreeNode& at) const;
};

/// Builds the trees of a scene by `config`, whatever tracer renders. Throws Error as buildTraceData() does; Cancelled
/// where control.cancel turns true.
TreeInspection inspectTrees(const Scene& scene, const TraceConfig& config, const BuildControl& control = {});

/// measureEpo() of a tree over primitives; quadrics have no part in it. Takes seconds for a million triangles.
double measureTreeEpo(const TreeInspection& trees, uint32_t tree);

/// Which boxes to draw.
struct BoxFilter {
    uint32_t depthMin = 0;  ///< inclusive, of TreeInspection::depth()
    uint32_t depthMax = 0;  ///< inclusive
    bool leavesOnly = false;

    bool operator==(const BoxFilter&) const = default;
};

/// How many boxes a filter lets through, each placement of a tree counted.
size_t countBoxes(const TreeInspection& trees, const BoxFilter& filter);

/// Axis-aligned in the world, around a node's box, as far as that is within the bounds of its placement.
Aabb worldBox(const TreeInspection& trees, const TreeNode& at);

}  // namespace raylab
