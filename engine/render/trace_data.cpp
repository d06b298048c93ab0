#include "engine/render/trace_data.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "engine/accel/builders.h"
#include "engine/accel/bvh_cache.h"
#include "engine/accel/halving_order.h"
#include "engine/accel/layout_bvh4b.h"
#include "engine/accel/optimise.h"
#include "engine/accel/refit.h"
#include "engine/core/error.h"
#include "engine/render/primitive_soup.h"
#include "engine/render/triangle_record.h"
#include "engine/scene/instance_motion.h"
#include "engine/scene/needs.h"
#include "engine/scene/quadric.h"

namespace raylab {
namespace {

constexpr int kUpperDepth = 20;    // of the tree over instances at most
constexpr int kTriangleDepth = 40;  // of a tree over triangles at most

/// The tables' rows that a config names.
struct Choice {
    const TraceConfig& config;
    const LayoutInfo* layout;  ///< nullptr: no nodes
    uint32_t triangleTest;
    uint32_t triangleWords;
    const BuildControl& control;
    const BvhCache* cache;  ///< nullptr: none
};

Bvh orderAlone(std::vector<uint32_t> order, size_t primitives) {
    Bvh bvh;
    bvh.skipped = primitives - order.size();
    bvh.order = std::move(order);
    return bvh;
}

std::vector<uint32_t> usableIds(std::span<const Aabb> bounds) {
    std::vector<uint32_t> ids;
    for (uint32_t i = 0; i < bounds.size(); ++i)
        if (bounds[i].usable()) ids.push_back(i);
    return ids;
}

Bvh buildOptimised(const Choice& choice, const BuildInput& input, const BvhConfig& config) {
    Bvh bvh = buildBvh(choice.config.builder, input, config, choice.control);
    if (choice.config.reinsertionPasses > 0)
        optimise(bvh, config, {.rounds = choice.config.reinsertionPasses}, choice.control);
    return bvh;
}

Bvh buildCached(const Choice& choice, const BuildInput& input, const BvhConfig& config) {
    if (choice.layout == nullptr) return orderAlone(usableIds(input.bounds), input.bounds.size());
    if (choice.cache == nullptr) return buildOptimised(choice, input, config);
    const std::string recipe = choice.config.builder + "+" + std::to_string(choice.config.reinsertionPasses);
    const BvhCacheKey key = bvhCacheKey(recipe, config, input.bounds, input.positions, input.triangles);
    if (std::optional<Bvh> found = loadCachedBvh(*choice.cache, key)) return std::move(*found);
    Bvh bvh = buildOptimised(choice, input, config);
    storeCachedBvh(*choice.cache, key, bvh);
    return bvh;
}

FlatTree flattenFor(const Choice& choice, const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase) {
    if (choice.layout == nullptr) return {.order = bvh.order};
    if (choice.layout->blocks) return flattenTreeBvh4b(bvh, nodeBase, slotBase, choice.triangleWords);
    return flatten(choice.layout->name, bvh, nodeBase, slotBase);
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

/// Writes the slots of a tree from its first one on, in its order.
void writeSlots(const PrimitiveSoup& soup, const std::vector<uint32_t>& order, uint32_t firstSlot,
                uint32_t firstQuadric, TraceData& data) {
    const auto triangleCount = static_cast<uint32_t>(soup.records.size());
    tbb::parallel_for(size_t{0}, order.size(), [&](size_t slot) {
        shared::TraceTriangle& record = data.triangles[firstSlot + slot];
        const uint32_t id = order[slot];
        record = id < triangleCount ? soup.records[id] : soup.quadricRecords[id - triangleCount];
        if (id >= triangleCount) record.p0.x = glm::uintBitsToFloat(firstQuadric + id - triangleCount);
    });
}

void appendSlots(const PrimitiveSoup& soup, const std::vector<uint32_t>& order, TraceData& data) {
    const auto firstSlot = static_cast<uint32_t>(data.triangles.size());
    data.triangles.resize(firstSlot + order.size());
    writeSlots(soup, order, firstSlot, static_cast<uint32_t>(data.quadrics.size()), data);
    data.quadrics.insert(data.quadrics.end(), soup.quadrics.begin(), soup.quadrics.end());
    data.quadricBounds.insert(data.quadricBounds.end(), soup.quadricBounds.begin(), soup.quadricBounds.end());
}

/// The primitives of a layout of blocks stand in its nodes.
void fillPrimitives(const Choice& choice, const TraceData& data, FlatTree& flat) {
    if (choice.layout == nullptr || !choice.layout->blocks) return;
    fillBlocks(choice, flat, [&](uint32_t slot, glm::uvec4* words) {
        const std::array<glm::uvec4, 4> packed = packTriangle(choice.triangleTest, data.triangles[slot]);
        std::copy_n(packed.begin(), choice.triangleWords, words);
        words->w |= shared::kBlockIsLeaf;
    });
}

/// Builds the tree of a soup and appends it to `data`. False where no primitive of it can be hit.
bool appendTree(const PrimitiveSoup& soup, const Choice& choice, PrimitiveTree tree, TraceData& data) {
    const SoupInput input(soup);
    BvhConfig config = choice.config.bvh;
    if (choice.layout != nullptr) config.maxLeafSize = std::min(config.maxLeafSize, choice.layout->maxLeafSize);
    config.maxDepth = kTriangleDepth;
    tree.bvh = buildCached(choice, {input.bounds, soup.positions, input.triangles}, config);
    data.skipped += tree.bvh.skipped;
    if (tree.bvh.order.empty()) return false;
    for (const uint32_t id : tree.bvh.order) tree.bounds.grow(input.bounds[id]);
    tree.firstSlot = static_cast<uint32_t>(data.triangles.size());
    tree.slotCount = static_cast<uint32_t>(tree.bvh.order.size());
    tree.firstQuadric = static_cast<uint32_t>(data.quadrics.size());
    FlatTree flat = flattenFor(choice, tree.bvh, static_cast<uint32_t>(data.nodeCount), tree.firstSlot);
    appendSlots(soup, flat.order, data);
    fillPrimitives(choice, data, flat);
    tree.root = flat.root;
    tree.grid = flat.grid;
    tree.stackEntries = flat.stackEntries;
    appendNodes(flat, data);
    data.trees.push_back(std::move(tree));
    return true;
}

shared::TraceInstance traceInstance(const PrimitiveTree& tree, const glm::mat4& objectToWorld, uint32_t instance) {
    const glm::mat4 rows(glm::transpose(glm::inverse(glm::dmat4(objectToWorld))));
    shared::TraceInstance record{};
    record.worldToObject0 = rows[0];
    record.worldToObject1 = rows[1];
    record.worldToObject2 = rows[2];
    record.gridOrigin = tree.grid.origin;
    record.root = tree.root;
    record.gridStep = tree.grid.step;
    record.instance = instance;
    record.firstSlot = tree.firstSlot;
    record.slotCount = tree.slotCount;
    return record;
}

/// World-space box of an instance's vertices and quadrics, widened by the rounding of the ray's way into object space.
Aabb worldBounds(const Mesh& mesh, const glm::mat4& matrix) {
    const glm::dmat4 m(matrix);
    glm::dvec3 lo(1e300), hi(-1e300);
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 q(m * glm::dvec4(position, 1.0));
        lo = glm::min(lo, q);
        hi = glm::max(hi, q);
    }
    for (const Quadric& quadric : mesh.quadrics) {
        const Aabb box = widened(quadricBounds(quadric, matrix));
        if (box.empty()) continue;
        lo = glm::min(lo, glm::dvec3(box.lo));
        hi = glm::max(hi, glm::dvec3(box.hi));
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
    for (const PrimitiveTree& tree : data.trees)
        if (tree.merged) {
            records.push_back(traceInstance(tree, glm::mat4(1.0f), shared::kInheritInstance));
            bounds.push_back(tree.bounds);
        }
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (treeOfMesh[instance.mesh] < 0) continue;
        const PrimitiveTree& tree = data.trees[static_cast<size_t>(treeOfMesh[instance.mesh])];
        records.push_back(traceInstance(tree, instance.objectToWorld, i));
        shown.push_back(&instance);
    }
    bounds.resize(records.size());
    const size_t first = records.size() - shown.size();
    tbb::parallel_for(size_t{0}, shown.size(), [&](size_t i) {
        const Mesh& mesh = scene.meshes[shown[i]->mesh];
        bounds[first + i] = worldBounds(mesh, shown[i]->objectToWorld);
        // Points move in straight lines, so that both ends' boxes bound them.
        if (moves(*shown[i])) bounds[first + i].grow(worldBounds(mesh, *shown[i]->endToWorld));
    });
    BvhConfig config = choice.config.bvh;
    config.maxLeafSize = 1;
    config.maxDepth = kUpperDepth;
    data.upper = choice.layout != nullptr ? buildBvh(kDefaultBuilder, {bounds, {}, {}}, config, choice.control)
                                          : orderAlone(halvingOrder(bounds), bounds.size());
    if (data.upper.order.empty()) return 0;
    FlatTree flat = flattenFor(choice, data.upper, static_cast<uint32_t>(data.nodeCount), 0);
    if (choice.layout != nullptr && choice.layout->blocks)
        fillBlocks(choice, flat, [](uint32_t slot, glm::uvec4* words) { words->w = shared::kBlockIsLeaf | slot; });
    data.root = flat.root;
    data.grid = flat.grid;
    appendNodes(flat, data);
    for (const uint32_t id : flat.order) data.instances.push_back(records[id]);
    return flat.stackEntries;
}

Choice makeChoice(const TraceConfig& config, const BuildControl& control, const BvhCache* cache) {
    const uint32_t test = findTriangleTest(config.triangle);
    return {config, config.layout.empty() ? nullptr : &findLayout(config.layout), test, triangleTests()[test].words, control,
            cache};
}

/// The index of each mesh's tree; -1 without one.
std::vector<int64_t> treesOfMeshes(const Scene& scene, const TraceData& data) {
    std::vector<int64_t> trees(scene.meshes.size(), -1);
    for (size_t i = 0; i < data.trees.size(); ++i)
        if (!data.trees[i].merged) trees[data.trees[i].mesh] = static_cast<int64_t>(i);
    return trees;
}

/// The slots and nodes of a tree whose boxes are others, behind the nodes that are there. A layout may cut it differently now.
void flattenAgain(const Scene& scene, const Choice& choice, PrimitiveTree& tree, bool changed, TraceData& data) {
    PrimitiveSoup soup;
    if (changed) {
        soup = meshSoup(scene, tree.mesh);
        if (choice.layout != nullptr) refit(tree.bvh, SoupInput(soup).bounds);
    }
    FlatTree flat = flattenFor(choice, tree.bvh, static_cast<uint32_t>(data.nodeCount), tree.firstSlot);
    if (changed) writeSlots(soup, flat.order, tree.firstSlot, tree.firstQuadric, data);
    fillPrimitives(choice, data, flat);
    tree.root = flat.root;
    tree.grid = flat.grid;
    tree.stackEntries = flat.stackEntries;
    appendNodes(flat, data);
}

uint32_t deepest(const std::vector<PrimitiveTree>& trees) {
    uint32_t entries = 0;
    for (const PrimitiveTree& tree : trees) entries = std::max(entries, tree.stackEntries);
    return entries;
}

}  // namespace

size_t TraceData::treeAtSlot(uint32_t firstSlot) const {
    const auto found = std::ranges::lower_bound(trees, firstSlot, {}, &PrimitiveTree::firstSlot);
    return static_cast<size_t>(found - trees.begin());
}

TreePlanConfig treePlanConfig(const TraceConfig& config) {
    const bool grid = !config.layout.empty() && findLayout(config.layout).gridOverTree;
    return {config.flattenLimit, grid, config.trees == Trees::mesh};
}

TraceData buildTraceData(const Scene& scene, const TraceConfig& config, const BuildControl& control) {
    TraceData data;
    const BvhCache cache{.folder = config.cache ? bvhCacheFolder() : ""};
    const Choice choice = makeChoice(config, control, config.cache ? &cache : nullptr);
    const TreePlan plan = planTrees(scene, treePlanConfig(config));
    PrimitiveTree merged;
    merged.merged = true;
    appendTree(mergedSoup(scene, plan), choice, merged, data);
    for (uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        if (!plan.ownTree[mesh]) continue;
        PrimitiveTree tree;
        tree.mesh = mesh;
        appendTree(meshSoup(scene, mesh), choice, tree, data);
    }
    data.lowerNodes = data.nodeCount;
    uint32_t upperEntries = 0;
    if (plan.hasUpperTree()) {
        upperEntries = buildUpper(scene, treesOfMeshes(scene, data), choice, data);
    } else if (!data.trees.empty()) {
        data.root = data.trees[0].root;
        data.grid = data.trees[0].grid;
        data.instances.push_back(traceInstance(data.trees[0], glm::mat4(1.0f), shared::kInheritInstance));
    }
    if (choice.layout != nullptr)
        data.stackEntries = upperEntries + deepest(data.trees) + choice.layout->kernelStackEntries;
    return data;
}

void updateTraceData(TraceData& data, const Scene& scene, const TraceConfig& config, const SceneChange& change) {
    if (config.trees != Trees::mesh)
        throw Error(scene.name + ": instances are merged, so that nothing can be moved; build with trees = mesh");
    const BuildControl control;
    const Choice choice = makeChoice(config, control, nullptr);
    const std::vector<int64_t> trees = treesOfMeshes(scene, data);
    data.nodes.resize(data.nodeCount > 0 ? data.nodes.size() / data.nodeCount * data.lowerNodes : 0);
    data.nodeCount = data.lowerNodes;
    if (!change.meshes.empty()) {
        data.nodes.clear();
        data.nodeCount = 0;
        for (PrimitiveTree& tree : data.trees)
            flattenAgain(scene, choice, tree, std::ranges::count(change.meshes, tree.mesh) > 0, data);
        data.lowerNodes = data.nodeCount;
    }
    data.instances.clear();
    const uint32_t upperEntries = buildUpper(scene, trees, choice, data);
    if (choice.layout != nullptr)
        data.stackEntries = upperEntries + deepest(data.trees) + choice.layout->kernelStackEntries;
}

}  // namespace raylab
