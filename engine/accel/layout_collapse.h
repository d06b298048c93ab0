#pragma once

#include <tbb/parallel_invoke.h>

#include <array>
#include <cstdint>
#include <memory>

#include "engine/accel/bvh.h"

namespace raylab {

/// What a wide layout is optimised for.
struct WideConfig {
    uint32_t maxLeafSize;  ///< primitives in a leaf child at most; kMaxLeafSize must fit into the children of a node
    float nodeCost;
    float primitiveCost;  ///< in the same unit
};

/// A child of a wide node: an inner node, or primitives below a node of the binary tree.
struct WideChild {
    enum class Kind : uint8_t { empty, inner, leaf };
    Aabb bounds;
    uint32_t source = 0;  ///< node of the binary tree
    uint32_t skip = 0;    ///< leaf: primitives below `source` that belong to children before this one
    uint32_t count = 0;   ///< leaf: primitives
    Kind kind = Kind::empty;
};

template <int kWidth>
struct WideNode {
    uint32_t source = 0;  ///< node of the binary tree
    uint32_t size = 0;    ///< children that are there: the first ones
    std::array<WideChild, kWidth> children;
};

/// Which nodes of a binary tree become nodes of a wide one, by least SAH cost: the dynamic programme of Ylitie, Karras
/// and Laine 2017, section 3.2. Subtrees of few primitives become leaves where that is cheaper; a leaf of more than
/// maxLeafSize primitives takes several children of its parent, or a node of its own, all with its box. Trees whose
/// areas are all zero are opened as far as possible.
template <int kWidth>
class WideCollapse {
public:
    WideCollapse(const Bvh& bvh, const WideConfig& config)
        : bvh_(bvh), config_(config), forests_(new Forest[bvh.nodes.size()]) {
        if (!bvh.nodes.empty()) solve(0, 0);
    }

    uint32_t primitivesBelow(uint32_t source) const { return forests_[source].primitives; }

    /// The wide node that stands for `source`: the root or a child of kind inner.
    WideNode<kWidth> open(uint32_t source) const {
        WideNode<kWidth> node;
        node.source = source;
        if (bvh_.nodes[source].isLeaf())
            addLeaf(source, node);
        else
            addBoth(source, forests_[source].choice[kWidth - 1], node);
        return node;
    }

private:
    static constexpr uint8_t kAsLeaf = 0x00;
    static constexpr uint8_t kAsInner = 0xff;
    static constexpr int kParallelDepth = 10;

    /// The best ways to hand what is below a node to its parent as at most i + 1 children, for each i. `choice` is
    /// kAsLeaf, kAsInner, or how many of them the left child (low four bits) and the right one get. The last choice is
    /// that of a node that is opened.
    struct Forest {
        std::array<float, kWidth - 1> cost;
        std::array<uint8_t, kWidth> choice;
        uint32_t primitives;
    };

    uint32_t pieces(uint32_t primitives) const {
        return (primitives + config_.maxLeafSize - 1) / config_.maxLeafSize;
    }

    void solve(uint32_t source, int depth) {
        const BvhNode& node = bvh_.nodes[source];
        if (node.isLeaf()) return solveLeaf(node, forests_[source]);
        if (depth < kParallelDepth) {
            tbb::parallel_invoke([&] { solve(node.left, depth + 1); }, [&] { solve(node.left + 1, depth + 1); });
        } else {
            solve(node.left, depth + 1);
            solve(node.left + 1, depth + 1);
        }
        solveInner(node, forests_[source]);
    }

    void solveLeaf(const BvhNode& node, Forest& forest) const {
        forest.primitives = node.count;
        const float area = node.bounds.halfArea();
        const float asLeaf = area * static_cast<float>(node.count) * config_.primitiveCost;
        for (uint32_t i = 0; i < kWidth; ++i) {
            const bool fits = i + 1 >= pieces(node.count);
            forest.choice[i] = fits ? kAsLeaf : kAsInner;
            if (i < kWidth - 1) forest.cost[i] = fits ? asLeaf : asLeaf + area * config_.nodeCost;
        }
    }

    void solveInner(const BvhNode& node, Forest& forest) const {
        const Forest& left = forests_[node.left];
        const Forest& right = forests_[node.left + 1];
        std::array<float, kWidth> shared;  // cost of at most i + 1 children, from both sides
        std::array<uint8_t, kWidth> shares;
        for (int i = 1; i < kWidth; ++i) {
            shared[i] = left.cost[0] + right.cost[i - 1];
            shares[i] = static_cast<uint8_t>(1 | (i << 4));
            for (int k = 1; k < i; ++k) {
                const float cost = left.cost[k] + right.cost[i - 1 - k];
                const bool better = cost < shared[i];
                shared[i] = better ? cost : shared[i];
                shares[i] = better ? static_cast<uint8_t>((k + 1) | ((i - k) << 4)) : shares[i];
            }
        }
        const float area = node.bounds.halfArea();
        forest.primitives = left.primitives + right.primitives;
        const float asInner = shared[kWidth - 1] + area * config_.nodeCost;
        const float asLeaf = area * static_cast<float>(forest.primitives) * config_.primitiveCost;
        const bool leaf = forest.primitives <= config_.maxLeafSize && asLeaf <= asInner;
        forest.cost[0] = leaf ? asLeaf : asInner;
        forest.choice[0] = leaf ? kAsLeaf : kAsInner;
        for (int i = 1; i < kWidth - 1; ++i) {
            const bool better = shared[i] <= forest.cost[i - 1];
            forest.cost[i] = better ? shared[i] : forest.cost[i - 1];
            forest.choice[i] = better ? shares[i] : forest.choice[i - 1];
        }
        forest.choice[kWidth - 1] = shares[kWidth - 1];
    }

    void add(uint32_t source, uint32_t share, WideNode<kWidth>& node) const {
        const uint8_t choice = forests_[source].choice[share - 1];
        if (choice == kAsLeaf)
            addLeaf(source, node);
        else if (choice == kAsInner)
            node.children[node.size++] = {bvh_.nodes[source].bounds, source, 0, 0, WideChild::Kind::inner};
        else
            addBoth(source, choice, node);
    }

    void addBoth(uint32_t source, uint8_t choice, WideNode<kWidth>& node) const {
        add(bvh_.nodes[source].left, choice & 15u, node);
        add(bvh_.nodes[source].left + 1, choice >> 4, node);
    }

    void addLeaf(uint32_t source, WideNode<kWidth>& node) const {
        const uint32_t primitives = forests_[source].primitives;
        uint32_t left = pieces(primitives);
        for (uint32_t first = 0; first < primitives; --left) {
            const uint32_t count = (primitives - first + left - 1) / left;
            node.children[node.size++] = {bvh_.nodes[source].bounds, source, first, count, WideChild::Kind::leaf};
            first += count;
        }
    }

    const Bvh& bvh_;
    WideConfig config_;
    std::unique_ptr<Forest[]> forests_;  ///< of each node of the binary tree
};

}  // namespace raylab
