#include "engine/measure/tree_inspection.h"

#include <algorithm>

#include "engine/core/stopwatch.h"
#include "engine/measure/bvh_report.h"

namespace raylab {
namespace {

/// The same trees in a layout that keeps the order of their primitives.
TraceConfig inOrder(TraceConfig config) {
    const LayoutInfo& layout = findLayout(config.layout.empty() ? "bvh2" : config.layout);
    config.bvh.maxLeafSize = std::min(config.bvh.maxLeafSize, layout.maxLeafSize);
    if (!layout.gridOverTree) config.layout = "bvh2";
    return config;
}

glm::mat4 fromRows(const shared::TraceInstance& record) {
    return glm::transpose(glm::mat4(record.worldToObject0, record.worldToObject1, record.worldToObject2, {0, 0, 0, 1}));
}

void placeTrees(TreeInspection& trees) {
    const TraceData& data = trees.data;
    for (const shared::TraceInstance& record : data.instances) {
        const glm::mat4 toObject = fromRows(record);
        const glm::mat4 toWorld(glm::inverse(glm::dmat4(toObject)));
        const auto tree = static_cast<uint32_t>(data.treeAtSlot(record.firstSlot));
        trees.placements.push_back({tree, record.instance, 0, data.trees[tree].bounds, toWorld, toObject});
    }
    for (size_t i = 0; i < data.upper.nodes.size(); ++i) {
        const BvhNode& node = data.upper.nodes[i];
        for (uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
            trees.placements[slot].rootDepth = trees.upperFacts[i].depth + 1;
            trees.placements[slot].bounds = node.bounds;
        }
    }
}

/// Nodes of a tree by depth: all, or leaves alone.
std::vector<size_t> countByDepth(const Bvh& bvh, const std::vector<NodeFacts>& facts, bool leavesOnly) {
    std::vector<size_t> counts;
    for (size_t i = 0; i < facts.size(); ++i) {
        if (leavesOnly && !bvh.nodes[i].isLeaf()) continue;
        if (counts.size() <= facts[i].depth) counts.resize(facts[i].depth + 1, 0);
        ++counts[facts[i].depth];
    }
    return counts;
}

size_t countBetween(const std::vector<size_t>& counts, uint32_t rootDepth, const BoxFilter& filter) {
    size_t sum = 0;
    for (size_t depth = 0; depth < counts.size(); ++depth)
        if (rootDepth + depth >= filter.depthMin && rootDepth + depth <= filter.depthMax) sum += counts[depth];
    return sum;
}

}  // namespace

TreeNode TreeInspection::root() const { return {data.upper.nodes.empty() ? placements[0].tree : kUpperTree, 0, 0}; }

uint32_t TreeInspection::depth(const TreeNode& at) const {
    return fact(at).depth + (at.tree == kUpperTree ? 0 : placements[at.placement].rootDepth);
}

std::vector<TreeNode> TreeInspection::children(const TreeNode& at) const {
    const BvhNode& n = node(at);
    if (!n.isLeaf()) return {{at.tree, n.left, at.placement}, {at.tree, n.left + 1, at.placement}};
    std::vector<TreeNode> roots;
    if (at.tree == kUpperTree)
        for (uint32_t slot = n.first; slot < n.first + n.count; ++slot)
            roots.push_back({placements[slot].tree, 0, slot});
    return roots;
}

glm::mat4 TreeInspection::toWorld(const TreeNode& at) const {
    return at.tree == kUpperTree ? glm::mat4(1.0f) : placements[at.placement].toWorld;
}

uint32_t TreeInspection::instance(const TreeNode& at) const {
    return at.tree == kUpperTree ? shared::kInheritInstance : placements[at.placement].instance;
}

TreeInspection inspectTrees(const Scene& scene, const TraceConfig& config, const BuildControl& control) {
    TreeInspection trees;
    trees.config = inOrder(config);
    const Stopwatch watch;
    trees.data = buildTraceData(scene, trees.config, control);
    trees.buildSeconds = watch.seconds();
    trees.sah = combinedSah(trees.data, trees.config);
    std::vector<glm::uvec4>().swap(trees.data.nodes);
    trees.upperFacts = inspectNodes(trees.data.upper, trees.config.bvh);
    for (const PrimitiveTree& tree : trees.data.trees) trees.facts.push_back(inspectNodes(tree.bvh, trees.config.bvh));
    placeTrees(trees);
    return trees;
}

double measureTreeEpo(const TreeInspection& trees, uint32_t tree) {
    const PrimitiveTree& of = trees.data.trees[tree];
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles(size_t{*std::ranges::max_element(of.bvh.order)} + 1, kBoxAlone);
    for (uint32_t slot = 0; slot < of.slotCount; ++slot) {
        const shared::TraceTriangle& t = trees.data.triangles[of.firstSlot + slot];
        if ((t.instance & shared::kSlotIsQuadric) != 0) continue;
        const auto base = static_cast<uint32_t>(positions.size());
        positions.insert(positions.end(), {t.p0, t.p1, t.p2});
        triangles[of.bvh.order[slot]] = {base, base + 1, base + 2};
    }
    return measureEpo(of.bvh, positions, triangles, trees.config.bvh);
}

size_t countBoxes(const TreeInspection& trees, const BoxFilter& filter) {
    if (trees.empty()) return 0;
    std::vector<std::vector<size_t>> counts;
    for (uint32_t tree = 0; tree < trees.facts.size(); ++tree)
        counts.push_back(countByDepth(trees.bvh(tree), trees.facts[tree], filter.leavesOnly));
    size_t sum =
        filter.leavesOnly ? 0 : countBetween(countByDepth(trees.data.upper, trees.upperFacts, false), 0, filter);
    for (const TreePlacement& placement : trees.placements)
        sum += countBetween(counts[placement.tree], placement.rootDepth, filter);
    return sum;
}

Aabb worldBox(const TreeInspection& trees, const TreeNode& at) {
    const Aabb& box = trees.node(at).bounds;
    if (at.tree == kUpperTree || trees.instance(at) == shared::kInheritInstance) return box;
    const glm::mat4& matrix = trees.placements[at.placement].toWorld;
    const glm::vec3 centre(matrix * glm::vec4(box.centroid(), 1.0f)), half = 0.5f * box.extent();
    const glm::vec3 reach = glm::abs(glm::vec3(matrix[0])) * half.x + glm::abs(glm::vec3(matrix[1])) * half.y +
                            glm::abs(glm::vec3(matrix[2])) * half.z;
    const Aabb& within = trees.placements[at.placement].bounds;
    return {glm::clamp(centre - reach, within.lo, within.hi), glm::clamp(centre + reach, within.lo, within.hi)};
}

}  // namespace raylab
