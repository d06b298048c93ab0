#include "engine/accel/refit.h"

#include <cassert>

#include "engine/accel/build_parallel.h"

namespace raylab {
namespace {

struct Refit {
    Bvh& bvh;
    std::span<const Aabb> bounds;

    void node(size_t index) const {
        BvhNode& node = bvh.nodes[index];
        if (!node.isLeaf()) {
            node.bounds = bvh.nodes[node.left].bounds;
            node.bounds.grow(bvh.nodes[node.left + 1].bounds);
            return;
        }
        Aabb box;
        for (size_t slot = node.first; slot < size_t{node.first} + node.count; ++slot) {
            assert(bvh.order[slot] < bounds.size());
            const Aabb& primitive = bounds[bvh.order[slot]];
            if (primitive.usable()) box.grow(primitive);
        }
        if (!box.empty()) node.bounds = box;
    }

    /// The subtree below a node, whose nodes are those from its left child on up to `end`, and the node itself.
    void subtree(size_t index, size_t end) const {
        const BvhNode& node = bvh.nodes[index];
        if (!node.isLeaf()) {
            const size_t left = node.left;
            const BvhNode& right = bvh.nodes[left + 1];
            if (end - left > kSubtree) {
                const size_t endOfLeft = right.isLeaf() ? end : right.left;
                parallelInvoke([&] { subtree(left, endOfLeft); }, [&] { subtree(left + 1, end); });
            } else {
                for (size_t i = end; i-- > left;) this->node(i);
            }
        }
        this->node(index);
    }
};

}  // namespace

void refit(Bvh& bvh, std::span<const Aabb> bounds) {
    if (!bvh.nodes.empty()) Refit{bvh, bounds}.subtree(0, bvh.nodes.size());
}

}  // namespace raylab
