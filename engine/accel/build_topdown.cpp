#include "engine/accel/build_topdown.h"

#include <algorithm>

namespace raylab {
namespace {

/// Where a subtree goes: its root into nodes[slot], the others from nodes[below] on, its primitives from order[first]
/// on.
struct Placement {
    const Subtree* subtree;
    size_t slot;
    size_t below;
    size_t first;
};

struct Sizes {
    size_t nodes;
    size_t primitives;
};

Sizes sizesOf(const TopNode& top) {
    if (!top.left) return {top.subtree.nodes.size(), top.subtree.order.size()};
    const Sizes left = sizesOf(*top.left);
    const Sizes right = sizesOf(*top.right);
    return {1 + left.nodes + right.nodes, left.primitives + right.primitives};
}

/// Writes the top nodes and lists the subtrees; `next` are the first node and the first slot of `order` that are free,
/// before and after.
void place(const TopNode& top, size_t slot, Sizes& next, Bvh& bvh, std::vector<Placement>& list) {
    if (!top.left) {
        list.push_back({&top.subtree, slot, next.nodes, next.primitives});
        next.nodes += top.subtree.nodes.size() - 1;
        next.primitives += top.subtree.order.size();
        bvh.depth = std::max(bvh.depth, top.subtree.depth);
        return;
    }
    const size_t left = next.nodes;
    bvh.nodes[slot].bounds = top.bounds;
    bvh.nodes[slot].left = static_cast<uint32_t>(left);
    next.nodes += 2;
    place(*top.left, left, next, bvh, list);
    place(*top.right, left + 1, next, bvh, list);
}

void copySubtree(const Placement& placement, Bvh& bvh) {
    const Subtree& subtree = *placement.subtree;
    for (size_t i = 0; i < subtree.nodes.size(); ++i) {
        BvhNode& node = bvh.nodes[i == 0 ? placement.slot : placement.below + i - 1];
        node = subtree.nodes[i];
        if (node.isLeaf())
            node.first += static_cast<uint32_t>(placement.first);
        else
            node.left += static_cast<uint32_t>(placement.below - 1);
    }
    std::copy(subtree.order.begin(), subtree.order.end(), bvh.order.begin() + placement.first);
}

}  // namespace

Bvh joinSubtrees(const TopNode& root) {
    const Sizes sizes = sizesOf(root);
    Bvh bvh;
    bvh.nodes.resize(sizes.nodes);
    bvh.order.resize(sizes.primitives);
    std::vector<Placement> list;
    Sizes next{1, 0};
    place(root, 0, next, bvh, list);
    parallelFor(list.size(), [&](size_t i) { copySubtree(list[i], bvh); });
    return bvh;
}

}  // namespace raylab
