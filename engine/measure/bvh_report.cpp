#include "engine/measure/bvh_report.h"

#include <algorithm>
#include <span>
#include <unordered_map>

#include "engine/core/stopwatch.h"
#include "engine/render/triangle_record.h"

namespace raylab {
namespace {

double halfArea(const Aabb& box) { return box.empty() ? 0.0 : static_cast<double>(box.halfArea()); }

/// Slots of a tree beyond the first of each triangle.
size_t countDuplicates(const Bvh& bvh) {
    std::vector<bool> seen;
    size_t duplicates = 0;
    for (const uint32_t id : bvh.order) {
        if (id >= seen.size()) seen.resize(size_t{id} + 1);
        duplicates += seen[id] ? 1 : 0;
        seen[id] = true;
    }
    return duplicates;
}

/// The vertices of a tree's triangles by their id in it. Quadrics and what it left out have no surface here.
struct TreeMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
};

/// `order`: the triangle of each slot, which a layout may have changed.
TreeMesh treeMesh(const TraceData& data, const PrimitiveTree& tree, const std::vector<uint32_t>& order) {
    TreeMesh mesh;
    mesh.triangles.resize(size_t{*std::ranges::max_element(order)} + 1, kBoxAlone);
    for (uint32_t slot = 0; slot < tree.slotCount; ++slot) {
        const shared::TraceTriangle& t = data.triangles[tree.firstSlot + slot];
        if ((t.instance & shared::kSlotIsQuadric) != 0) continue;
        const auto base = static_cast<uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {t.p0, t.p1, t.p2});
        mesh.triangles[order[slot]] = {base, base + 1, base + 2};
    }
    return mesh;
}

void measureSlowly(const TraceData& data, const PrimitiveTree& tree, const TraceConfig& config, BvhReport& report) {
    const Stopwatch watch;
    const FlatTree flat = flatten(config.layout, tree.bvh, 0, 0);
    report.flattenMs = watch.seconds() * 1e3;
    const TreeMesh mesh = treeMesh(data, tree, flat.order);
    report.epo = measureEpo(tree.bvh, mesh.positions, mesh.triangles, config.bvh);
}

void measureMemory(const TraceData& data, const TraceConfig& config, BvhReport& report) {
    const size_t recordBytes = triangleTests()[findTriangleTest(config.triangle)].words * sizeof(glm::uvec4);
    report.nodeBytes = std::as_bytes(std::span(data.nodes)).size();
    report.triangleBytes = findLayout(config.layout).blocks ? 0 : data.triangles.size() * recordBytes;
    report.instanceBytes = std::as_bytes(std::span(data.instances)).size();
}

/// The SAH of the tree below each primitive of the upper tree. A layout may have changed the order of the instances.
std::vector<double> sahBelowUpper(const TraceData& data, const TraceConfig& config) {
    std::unordered_map<uint32_t, double> sahOfRoot;
    for (const PrimitiveTree& tree : data.trees) sahOfRoot[tree.root] = measureQuality(tree.bvh, config.bvh).sah;
    const std::vector<uint32_t> order = flatten(config.layout, data.upper, 0, 0).order;
    std::vector<double> below(size_t{*std::ranges::max_element(order)} + 1, 0.0);
    for (size_t slot = 0; slot < order.size(); ++slot) below[order[slot]] = sahOfRoot.at(data.instances[slot].root);
    return below;
}

}  // namespace

double combinedSah(const TraceData& data, const TraceConfig& config) {
    if (data.trees.empty()) return 0.0;
    if (data.upper.nodes.empty()) return measureQuality(data.trees[0].bvh, config.bvh).sah;
    const double rootArea = halfArea(data.upper.nodes[0].bounds);
    if (!(rootArea > 0.0)) return 0.0;
    const std::vector<double> below = sahBelowUpper(data, config);
    double sum = 0.0;
    for (const BvhNode& node : data.upper.nodes) {
        const double share = halfArea(node.bounds) / rootArea;
        if (!node.isLeaf()) sum += share * static_cast<double>(config.bvh.traversalCost);
        for (uint32_t slot = node.first; slot < node.first + node.count; ++slot)
            sum += share * below[data.upper.order[slot]];
    }
    return sum;
}

BvhReport measureBvh(const Scene& scene, const TraceConfig& config, BvhDetail detail) {
    BvhReport report{.builder = config.builder, .layout = config.layout, .triangle = config.triangle};
    const Stopwatch watch;
    const TraceData data = buildTraceData(scene, config);
    report.buildMs = watch.seconds() * 1e3;
    report.sah = combinedSah(data, config);
    report.trees = data.trees.size();
    report.nodes = data.upper.nodes.size();
    report.flatNodes = data.nodeCount;
    report.skipped = data.skipped;
    for (const PrimitiveTree& tree : data.trees) {
        report.depth = std::max(report.depth, static_cast<int>(tree.bvh.depth));
        report.nodes += tree.bvh.nodes.size();
        report.duplicates += countDuplicates(tree.bvh);
    }
    report.depth += static_cast<int>(data.upper.depth);
    measureMemory(data, config, report);
    const auto largest = std::ranges::max_element(data.trees, {}, &PrimitiveTree::slotCount);
    if (largest == data.trees.end()) return report;
    report.largest = measureQuality(largest->bvh, config.bvh);
    if (detail == BvhDetail::full) measureSlowly(data, *largest, config, report);
    return report;
}

}  // namespace raylab
