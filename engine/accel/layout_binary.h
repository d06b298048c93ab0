#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

#include "engine/accel/layout.h"

namespace raylab {

/// How many inner nodes come before each node: its place among the nodes of a binary layout. `total`: all of them.
inline std::vector<uint32_t> innerNodesBefore(const std::vector<BvhNode>& nodes, uint32_t& total) {
    std::vector<uint32_t> before(nodes.size());
    total = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
        before[i] = total;
        total += nodes[i].isLeaf() ? 0u : 1u;
    }
    return before;
}

/// What the binary layouts share. An inner node becomes a Node, children that are inner nodes stay neighbours, depth
/// first. A tree of one leaf gets a node over its two halves; of one primitive, over that primitive twice, as testing
/// it again is harmless and an absent child's box could be hit by a min/max slab test. `makeNode(box0, box1, child0,
/// child1)` returns a Node; `out` gets them as Words, of which a Node is a whole number. Not for an empty tree.
template <class Node, class Word, class MakeNode>
void flattenBinary(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase, const MakeNode& makeNode,
                   std::vector<Word>& out) {
    static_assert(sizeof(Node) % sizeof(Word) == 0);
    constexpr size_t kWords = sizeof(Node) / sizeof(Word);
    requireAddressable(bvh.nodes.size(), nodeBase, kLeafBit, bvh.order.size(), slotBase);
    const BvhNode& root = bvh.nodes[0];
    if (root.isLeaf()) {
        const uint32_t half = (root.count + 1) / 2;
        const uint32_t child0 = leafReference(slotBase + root.first, half);
        const uint32_t child1 =
            root.count == 1 ? child0 : leafReference(slotBase + root.first + half, root.count - half);
        const Node node = makeNode(root.bounds, root.bounds, child0, child1);
        out.resize(kWords);
        std::memcpy(out.data(), &node, sizeof(Node));
        return;
    }
    uint32_t innerNodes = 0;
    const std::vector<uint32_t> index = innerNodesBefore(bvh.nodes, innerNodes);
    const auto reference = [&](uint32_t child) {
        const BvhNode& node = bvh.nodes[child];
        return node.isLeaf() ? leafReference(slotBase + node.first, node.count) : nodeBase + index[child];
    };
    out.resize(innerNodes * kWords);
    tbb::parallel_for(size_t{0}, bvh.nodes.size(), [&](size_t i) {
        const BvhNode& source = bvh.nodes[i];
        if (source.isLeaf()) return;
        const Node node = makeNode(bvh.nodes[source.left].bounds, bvh.nodes[source.left + 1].bounds,
                                   reference(source.left), reference(source.left + 1));
        std::memcpy(out.data() + index[i] * kWords, &node, sizeof(Node));
    });
}

/// The fields of a FlatTree of a binary layout that do not depend on its nodes' form.
template <class Node>
void finishBinary(const Bvh& bvh, uint32_t nodeBase, FlatTree& tree) {
    tree.root = nodeBase;
    tree.nodeCount = static_cast<uint32_t>(tree.words.size() * sizeof(glm::uvec4) / sizeof(Node));
    tree.stackEntries = std::max(bvh.depth, 1u);  // one for each inner node on the way down
    tree.order = bvh.order;
}

}  // namespace raylab
