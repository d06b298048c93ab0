#include "engine/render/trace_data.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "engine/accel/builders.h"
#include "engine/accel/bvh_cache.h"
#include "engine/accel/layout_bvh4b.h"
#include "engine/accel/optimise.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/core/error.h"
#include "engine/render/opacity_map.h"
#include "engine/render/triangle_record.h"
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

/// `opacity`: of the mesh's triangles.
void appendMesh(const Mesh& mesh, std::span<const uint32_t> opacity, const glm::mat4& matrix, uint32_t instance,
                TriangleSoup& soup) {
    const auto base = static_cast<uint32_t>(soup.positions.size());
    const bool identity = matrix == glm::mat4(1.0f);
    for (const glm::vec3& p : mesh.positions)
        soup.positions.push_back(identity ? p : glm::vec3(matrix * glm::vec4(p, 1.0f)));
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3 t = mesh.triangles[i] + base;
        soup.triangles.push_back(t);
        soup.records.push_back({soup.positions[t.x], instance, soup.positions[t.y], i, soup.positions[t.z], opacity[i]});
    }
}

TriangleSoup mergedSoup(const Scene& scene, const TreePlan& plan) {
    TriangleSoup soup;
    std::vector<std::vector<uint32_t>> opacity(scene.meshes.size());  // made once, however often the mesh is shown
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (plan.ownTree[instance.mesh]) continue;
        if (opacity[instance.mesh].empty()) opacity[instance.mesh] = opacityMaps(scene, mesh);
        appendMesh(mesh, opacity[instance.mesh], instance.objectToWorld, i, soup);
    }
    return soup;
}

/// The tables' rows that a config names.
struct Choice {
    const TraceConfig& config;
    const LayoutInfo& layout;
    uint32_t triangleTest;
    uint32_t triangleWords;
    const BuildControl& control;
    const BvhCache* cache;  ///< nullptr: none
};

Bvh buildOptimised(const Choice& choice, const BuildInput& input, const BvhConfig& config) {
    Bvh bvh = buildBvh(choice.config.builder, input, config, choice.control);
    if (choice.config.reinsertionPasses > 0)
        optimise(bvh, config, {.rounds = choice.config.reinsertionPasses}, choice.control);
    return bvh;
}

Bvh buildCached(const Choice& choice, const BuildInput& input, const BvhConfig& config) {
    if (choice.cache == nullptr) return buildOptimised(choice, input, config);
    const std::string recipe = choice.config.builder + "+" + std::to_string(choice.config.reinsertionPasses);
    const BvhCacheKey key = bvhCacheKey(recipe, config, input.bounds, input.positions, input.triangles);
    if (std::optional<Bvh> found = loadCachedBvh(*choice.cache, key)) return std::move(*found);
    Bvh bvh = buildOptimised(choice, input, config);
    storeCachedBvh(*choice.cache, key, bvh);
    return bvh;
}

FlatTree flattenFor(const Choice& choice, const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase) {
    if (choice.layout.blocks) return flattenTreeBvh4b(bvh, nodeBase, slotBase, choice.triangleWords);
    return flatten(choice.layout.name, bvh, nodeBase, slotBase);
}

/// Fills the blocks that are primitives: `fill(slot, words)`.
template <class Fill>
void fillBlocks(const Choice& choice, FlatTree& flat, const Fill& fill) {
    tbb::parallel_for(size_t{0}, size_t{flat.nodeCount}, [&](size_t i) {
        glm::uvec4* words = &flat.words[i * choice.triangleWords];
        if (isLeafReference(words->w)) fill(words->w & ~kLeafBit, words);
    });
}

void appendNodes(const FlatTree& flat, TraceData& data) {
    data.nodes.insert(data.nodes.end(), flat.words.begin(), flat.words.end());
    data.nodeCount += flat.nodeCount;
}

/// Builds the tree of a soup and appends it to `data`. False where no triangle of it can be hit.
bool appendTree(const TriangleSoup& soup, const Choice& choice, TriangleTree tree, TraceData& data) {
    const std::vector<Aabb> bounds = triangleBounds(soup.positions, soup.triangles);
    BvhConfig config = choice.config.bvh;
    config.maxLeafSize = std::min(config.maxLeafSize, choice.layout.maxLeafSize);
    config.maxDepth = kTriangleDepth;
    tree.bvh = buildCached(choice, {bounds, soup.positions, soup.triangles}, config);
    data.skippedTriangles += tree.bvh.skipped;
    if (tree.bvh.order.empty()) return false;
    tree.firstTriangle = static_cast<uint32_t>(data.triangles.size());
    tree.triangleCount = static_cast<uint32_t>(tree.bvh.order.size());
    FlatTree flat = flattenFor(choice, tree.bvh, static_cast<uint32_t>(data.nodeCount), tree.firstTriangle);
    data.triangles.resize(data.triangles.size() + tree.triangleCount);
    tbb::parallel_for(uint32_t{0}, tree.triangleCount, [&](uint32_t slot) {
        data.triangles[tree.firstTriangle + slot] = soup.records[flat.order[slot]];
    });
    if (choice.layout.blocks)
        fillBlocks(choice, flat, [&](uint32_t slot, glm::uvec4* words) {
            const std::array<glm::uvec4, 4> packed = packTriangle(choice.triangleTest, data.triangles[slot]);
            std::copy_n(packed.begin(), choice.triangleWords, words);
            words->w |= shared::kBlockIsLeaf;
        });
    tree.root = flat.root;
    tree.grid = flat.grid;
    tree.stackEntries = flat.stackEntries;
    appendNodes(flat, data);
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

/// The upper tree over the merged tree and every instance of a mesh with a tree of its own. Returns the stack entries of its
/// walk.
uint32_t buildUpper(const Scene& scene, const std::vector<int64_t>& treeOfMesh, const Choice& choice, TraceData& data) {
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
    BvhConfig config = choice.config.bvh;
    config.maxLeafSize = 1;
    config.maxDepth = kUpperDepth;
    data.upper = buildBvh(kDefaultBuilder, {bounds, {}, {}}, config, choice.control);
    if (data.upper.order.empty()) return 0;
    FlatTree flat = flattenFor(choice, data.upper, static_cast<uint32_t>(data.nodeCount), 0);
    if (choice.layout.blocks)
        fillBlocks(choice, flat, [](uint32_t slot, glm::uvec4* words) { words->w = shared::kBlockIsLeaf | slot; });
    data.root = flat.root;
    data.grid = flat.grid;
    appendNodes(flat, data);
    for (const uint32_t id : flat.order) data.instances.push_back(records[id]);
    return flat.stackEntries;
}

uint32_t deepest(const std::vector<TriangleTree>& trees) {
    uint32_t entries = 0;
    for (const TriangleTree& tree : trees) entries = std::max(entries, tree.stackEntries);
    return entries;
}

}  // namespace

TreePlanConfig treePlanConfig(const TraceConfig& config) {
    return {config.flattenLimit, findLayout(config.layout).gridOverTree};
}

TraceData buildTraceData(const Scene& scene, const TraceConfig& config, const BuildControl& control) {
    TraceData data;
    const uint32_t test = findTriangleTest(config.triangle);
    const BvhCache cache{.folder = config.cache ? bvhCacheFolder() : ""};
    const Choice choice{config,  findLayout(config.layout), test, triangleTests()[test].words,
                        control, config.cache ? &cache : nullptr};
    const TreePlan plan = planTrees(scene, treePlanConfig(config));
    TriangleTree merged;
    merged.merged = true;
    appendTree(mergedSoup(scene, plan), choice, merged, data);
    std::vector<int64_t> treeOfMesh(scene.meshes.size(), -1);
    for (uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        if (!plan.ownTree[mesh]) continue;
        TriangleSoup soup;
        appendMesh(scene.meshes[mesh], opacityMaps(scene, scene.meshes[mesh]), glm::mat4(1.0f), shared::kInheritInstance, soup);
        TriangleTree tree;
        tree.mesh = mesh;
        if (appendTree(soup, choice, tree, data)) treeOfMesh[mesh] = static_cast<int64_t>(data.trees.size()) - 1;
    }
    uint32_t upperEntries = 0;
    if (plan.hasUpperTree()) {
        upperEntries = buildUpper(scene, treeOfMesh, choice, data);
    } else if (!data.trees.empty()) {
        data.root = data.trees[0].root;
        data.grid = data.trees[0].grid;
        data.instances.push_back(traceInstance(data.trees[0], glm::mat4(1.0f), shared::kInheritInstance));
    }
    data.stackEntries = upperEntries + deepest(data.trees) + choice.layout.kernelStackEntries;
    return data;
}

}  // namespace raylab
