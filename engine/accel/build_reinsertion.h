#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/accel/bvh.h"
#include "engine/accel/float4.h"

namespace raylab {

constexpr uint32_t kNoNode = 0xffffffffu;

/// A move of a subtree that looks worth it: `node` becomes the sibling of `target`, below a new parent.
struct Reinsertion {
    uint32_t node = kNoNode;
    uint32_t target = kNoNode;  ///< kNoNode: there is no better place
    float gain = 0.0f;          ///< in half area of inner nodes
};

/// A tree whose subtrees can be moved, over the nodes of a Bvh by the same indices: the root is 0, leaves stay leaves.
class ReinsertionTree {
public:
    struct Node {
        Box4 box;
        uint32_t parent = kNoNode;
        uint32_t left = kNoNode;  ///< kNoNode: a leaf
        uint32_t right = kNoNode;

        bool isLeaf() const { return left == kNoNode; }
    };

    explicit ReinsertionTree(const Bvh& bvh);
    std::span<const Node> nodes() const { return nodes_; }
    /// The sum over inner nodes, in half area.
    double innerArea() const;

    /// Where to put a node to gain most. `stack` is memory for this thread.
    Reinsertion search(uint32_t node, std::vector<std::pair<uint32_t, float>>& stack) const;
    /// Makes the move if it is possible and pays as the tree is now; returns what it gains, or 0.
    double apply(const Reinsertion& reinsertion);

private:
    bool mayMove(uint32_t node) const;
    bool isBelow(uint32_t node, uint32_t ancestor) const;
    uint32_t siblingOf(uint32_t node) const;
    void replaceChild(uint32_t parent, uint32_t child, uint32_t by);
    /// Both return how much the sum of areas grows.
    double move(uint32_t node, uint32_t target);
    double refitUp(uint32_t node);

    std::vector<Node> nodes_;
};

}  // namespace raylab
