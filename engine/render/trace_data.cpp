#include "engine/render/trace_data.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "engine/accel/build_binned.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/core/error.h"
#include "engine/scene/needs.h"

namespace raylab {
namespace {

constexpr int kUpperDepth = 20;    // of the tree over instances at most
constexpr int kTriangleDepth = 40;  // of a tree over triangles at most

/// Triangles in their own order, before a tree sorts them.
struct TriangleSoup {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    std::vector<shared::TraceTriangle> records;
};

bool isAlphaTested(const Scene& scene, const Mesh& mesh) {
    return scene.materials[mesh.material].alphaMode != AlphaMode::opaque;
}

void appendMesh(const Scene& scene, const Mesh& mesh, const glm::mat4& matrix, uint32_t instance, TriangleSoup& soup) {
    const auto base = static_cast<uint32_t>(soup.positions.size());
    const bool identity = matrix == glm::mat4(1.0f);
    for (const glm::vec3& p : mesh.positions)
        soup.positions.push_back(identity ? p : glm::vec3(matrix * glm::vec4(p, 1.0f)));
    const uint32_t alpha = isAlphaTested(scene, mesh) ? 1u : 0u;
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3 t = mesh.triangles[i] + base;
        soup.triangles.push_back(t);
        soup.records.push_back({soup.positions[t.x], instance, soup.positions[t.y], i, soup.positions[t.z], alpha});
    }
}

TriangleSoup mergedSoup(const Scene& scene, const TreePlan& plan) {
    TriangleSoup soup;
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!plan.ownTree[instance.mesh])
            appendMesh(scene, scene.meshes[instance.mesh], instance.objectToWorld, i, soup);
    }
    return soup;
}

/// Builds the tree of a soup and appends it to `data`. False where no triangle of it can be hit.
bool appendTree(const TriangleSoup& soup, const BvhConfig& config, TriangleTree tree, TraceData& data) {
    tree.bvh = buildBinned(triangleBounds(soup.positions, soup.triangles), config);
    data.skippedTriangles += tree.bvh.skipped;
    if (tree.bvh.order.empty()) return false;
    tree.firstTriangle = static_cast<uint32_t>(data.triangles.size());
    tree.triangleCount = static_cast<uint32_t>(tree.bvh.order.size());
    if (size_t{tree.firstTriangle} + tree.triangleCount > kMaxBvhPrimitives)
        throw Error("the scene has more than 2^27 triangles; split it");
    tree.root = static_cast<uint32_t>(data.nodes.size());
    data.triangles.resize(data.triangles.size() + tree.triangleCount);
    tbb::parallel_for(uint32_t{0}, tree.triangleCount, [&](uint32_t slot) {
        data.triangles[tree.firstTriangle + slot] = soup.records[tree.bvh.order[slot]];
    });
    const TreeBvh2q flat = flattenBvh2q(tree.bvh, tree.root, tree.firstTriangle);
    tree.grid = flat.grid;
    tree.depth = flat.depth;
    data.nodes.insert(data.nodes.end(), flat.nodes.begin(), flat.nodes.end());
    data.trees.push_back(std::move(tree));
    return true;
}

shared::TraceInstance traceInstance(const TriangleTree& tree, const glm::mat4& objectToWorld, uint32_t instance) {
    const glm::mat4 rows(glm::transpose(glm::inverse(glm::dmat4(objectToWorld))));
    shared::TraceInstance record{};
    record.worldToObject0 = rows[0];
    record.worldToObject1 = rows[1];
    record.worldToObject2 = rows[2];
    record.gridOrigin = tree.grid.origin;
    record.root = tree.root;
    record.gridStep = tree.grid.step;
    record.instance = instance;
    record.firstTriangle = tree.firstTriangle;
    record.triangleCount = tree.triangleCount;
    return record;
}

/// World-space box of an instance's vertices, widened by the rounding of the ray's way into object space.
Aabb worldBounds(const Mesh& mesh, const glm::mat4& matrix) {
    const glm::dmat4 m(matrix);
    glm::dvec3 lo(1e300), hi(-1e300);
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 q(m * glm::dvec4(position, 1.0));
        lo = glm::min(lo, q);
        hi = glm::max(hi, q);
    }
    const glm::dvec3 slack = glm::max(glm::abs(lo), glm::abs(hi)) * 1e-6;
    return {glm::vec3(lo - slack), glm::vec3(hi + slack)};
}

/// The upper tree over the merged tree and every instance of a mesh with a tree of its own.
void buildUpper(const Scene& scene, const std::vector<int64_t>& treeOfMesh, const BvhConfig& config, TraceData& data) {
    std::vector<shared::TraceInstance> records;
    std::vector<Aabb> bounds;
    std::vector<const Instance*> shown;
    for (const TriangleTree& tree : data.trees)
        if (tree.merged) {
            records.push_back(traceInstance(tree, glm::mat4(1.0f), shared::kInheritInstance));
            bounds.push_back(tree.bvh.nodes[0].bounds);
        }
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (treeOfMesh[instance.mesh] < 0) continue;
        const TriangleTree& tree = data.trees[static_cast<size_t>(treeOfMesh[instance.mesh])];
        records.push_back(traceInstance(tree, instance.objectToWorld, i));
        shown.push_back(&instance);
    }
    bounds.resize(records.size());
    const size_t first = records.size() - shown.size();
    tbb::parallel_for(size_t{0}, shown.size(), [&](size_t i) {
        bounds[first + i] = worldBounds(scene.meshes[shown[i]->mesh], shown[i]->objectToWorld);
    });
    BvhConfig upperConfig = config;
    upperConfig.maxLeafSize = 1;
    upperConfig.maxDepth = kUpperDepth;
    data.upper = buildBinned(bounds, upperConfig);
    if (data.upper.order.empty()) return;
    const TreeBvh2q flat = flattenBvh2q(data.upper, static_cast<uint32_t>(data.nodes.size()), 0);
    data.root = static_cast<uint32_t>(data.nodes.size());
    data.grid = flat.grid;
    data.upperDepth = flat.depth;
    data.nodes.insert(data.nodes.end(), flat.nodes.begin(), flat.nodes.end());
    for (const uint32_t id : data.upper.order) data.instances.push_back(records[id]);
}

uint32_t deepest(const std::vector<TriangleTree>& trees) {
    uint32_t depth = 0;
    for (const TriangleTree& tree : trees) depth = std::max(depth, tree.depth);
    return depth;
}

}  // namespace

TraceData buildTraceData(const Scene& scene, const BvhConfig& config) {
    TraceData data;
    BvhConfig triangleConfig = config;
    triangleConfig.maxDepth = kTriangleDepth;
    const TreePlan plan = planTrees(scene);
    TriangleTree merged;
    merged.merged = true;
    appendTree(mergedSoup(scene, plan), triangleConfig, merged, data);
    std::vector<int64_t> treeOfMesh(scene.meshes.size(), -1);
    for (uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        if (!plan.ownTree[mesh]) continue;
        TriangleSoup soup;
        appendMesh(scene, scene.meshes[mesh], glm::mat4(1.0f), shared::kInheritInstance, soup);
        TriangleTree tree;
        tree.mesh = mesh;
        if (appendTree(soup, triangleConfig, tree, data)) treeOfMesh[mesh] = static_cast<int64_t>(data.trees.size()) - 1;
    }
    if (plan.hasUpperTree()) {
        buildUpper(scene, treeOfMesh, config, data);
    } else if (!data.trees.empty()) {
        data.root = data.trees[0].root;
        data.grid = data.trees[0].grid;
        data.instances.push_back(traceInstance(data.trees[0], glm::mat4(1.0f), shared::kInheritInstance));
    }
    // A walk keeps one entry a level and the bottom, and writes one entry past the top.
    data.stackEntries = data.upperDepth + deepest(data.trees) + 2;
    return data;
}

}  // namespace raylab
