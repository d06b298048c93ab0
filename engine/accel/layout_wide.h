#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "engine/accel/layout.h"
#include "engine/accel/layout_collapse.h"
#include "engine/accel/layout_frame.h"

namespace raylab {

/// Where a wide node's parts are, as absolute indices: children that are inner nodes are neighbours, and so are the
/// primitives of children that are leaves, both in the order of the children.
struct WidePlace {
    uint32_t firstChild = 0;
    uint32_t firstSlot = 0;
};

/// What the wide layouts share: numbers the nodes depth first, with inner children of a node side by side, and writes
/// each in its place. A Layout has
/// - `static constexpr int kWidth, kWords` (children and uvec4s of a node) and `static constexpr WideConfig kConfig`;
/// - `static void arrange(const Aabb& bounds, WideNode<kWidth>& node)`: moves children to where they are to be, `bounds`
///   being the node's;
/// - `static void encode(const Aabb& bounds, const WideNode<kWidth>& node, WidePlace place, glm::uvec4* words)`.
template <class Layout>
class WideFlattener {
public:
    WideFlattener(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase)
        : bvh_(bvh),
          nodeBase_(nodeBase),
          slotBase_(slotBase),
          collapse_(bvh, Layout::kConfig),
          nodesBelow_(new uint32_t[bvh.nodes.size()]) {}

    /// Not for an empty tree. `stackEntries` counts the nodes on a way down that have several inner children: what is
    /// left of each is one group on a walk's stack.
    FlatTree flatten(uint64_t nodeLimit) {
        FlatTree tree;
        tree.stackEntries = count(0);
        tree.nodeCount = 1 + nodesBelow_[0];
        requireAddressable(tree.nodeCount, nodeBase_, nodeLimit, collapse_.primitivesBelow(0), slotBase_);
        tree.root = nodeBase_;
        tree.words.resize(size_t{tree.nodeCount} * Layout::kWords);
        tree.order.resize(collapse_.primitivesBelow(0));
        emit({0, 0, 1, 0}, tree);
        return tree;
    }

private:
    static constexpr uint32_t kParallelPrimitives = 4096;
    using Node = WideNode<Layout::kWidth>;
    using Kind = WideChild::Kind;

    /// A node to be written: its index, and where the nodes and slots below it begin. Without the bases.
    struct Job {
        uint32_t source;
        uint32_t index;
        uint32_t nextNode;
        uint32_t nextSlot;
    };

    template <class Body>
    void forEach(uint32_t source, uint32_t size, const Body& body) const {
        if (collapse_.primitivesBelow(source) > kParallelPrimitives)
            tbb::parallel_for(uint32_t{0}, size, body);
        else
            for (uint32_t i = 0; i < size; ++i) body(i);
    }

    /// Fills nodesBelow_ from `source` down. Returns the most nodes of several inner children on a way down.
    uint32_t count(uint32_t source) {
        const Node node = collapse_.open(source);
        std::array<uint32_t, Layout::kWidth> levels{};
        std::array<uint32_t, Layout::kWidth> inner{};
        uint32_t size = 0;
        for (uint32_t i = 0; i < node.size; ++i)
            if (node.children[i].kind == Kind::inner) inner[size++] = node.children[i].source;
        forEach(source, size, [&](uint32_t i) { levels[i] = count(inner[i]); });
        uint32_t below = size;
        for (uint32_t i = 0; i < size; ++i) below += nodesBelow_[inner[i]];
        nodesBelow_[source] = below;
        return *std::max_element(levels.begin(), levels.end()) + (size > 1 ? 1 : 0);
    }

    void emit(const Job& job, FlatTree& tree) const {
        const Aabb& bounds = bvh_.nodes[job.source].bounds;
        Node node = collapse_.open(job.source);
        Layout::arrange(bounds, node);
        Layout::encode(bounds, node, {nodeBase_ + job.nextNode, slotBase_ + job.nextSlot},
                       &tree.words[size_t{job.index} * Layout::kWords]);
        std::array<Job, Layout::kWidth> jobs;
        uint32_t size = 0;
        Job next{0, job.nextNode, job.nextNode, job.nextSlot};
        for (const WideChild& child : node.children) {
            next.nextNode += child.kind == Kind::inner ? 1 : 0;
            if (child.kind == Kind::leaf) next.nextSlot = copyPrimitives(child, next.nextSlot, tree.order);
        }
        for (const WideChild& child : node.children)
            if (child.kind == Kind::inner) {
                next.source = child.source;
                jobs[size++] = next;
                ++next.index;
                next.nextNode += nodesBelow_[child.source];
                next.nextSlot += collapse_.primitivesBelow(child.source);
            }
        forEach(job.source, size, [&](uint32_t i) { emit(jobs[i], tree); });
    }

    /// Returns the slot after the last one.
    uint32_t copyPrimitives(const WideChild& child, uint32_t slot, std::vector<uint32_t>& order) const {
        const BvhNode& node = bvh_.nodes[child.source];
        if (!node.isLeaf()) return copySubtree(node, slot, order);
        std::copy_n(bvh_.order.begin() + node.first + child.skip, child.count, order.begin() + slot);
        return slot + child.count;
    }

    uint32_t copySubtree(const BvhNode& node, uint32_t slot, std::vector<uint32_t>& order) const {
        if (!node.isLeaf())
            return copySubtree(bvh_.nodes[node.left + 1], copySubtree(bvh_.nodes[node.left], slot, order), order);
        std::copy_n(bvh_.order.begin() + node.first, node.count, order.begin() + slot);
        return slot + node.count;
    }

    const Bvh& bvh_;
    uint32_t nodeBase_;
    uint32_t slotBase_;
    WideCollapse<Layout::kWidth> collapse_;
    std::unique_ptr<uint32_t[]> nodesBelow_;  ///< wide nodes below, by node of the binary tree; only of wide nodes
};

}  // namespace raylab
