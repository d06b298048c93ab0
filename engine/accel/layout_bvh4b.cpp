#include "engine/accel/layout_bvh4b.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

#include "engine/accel/layout_collapse.h"
#include "engine/accel/layout_frame.h"

namespace raylab {
namespace {

/// A primitive costs a step of the walk, like a node.
constexpr WideConfig kConfig{1, 1.0f, 1.0f};

class BlockFlattener {
public:
    BlockFlattener(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase, uint32_t blockWords)
        : bvh_(bvh),
          nodeBase_(nodeBase),
          slotBase_(slotBase),
          blockWords_(blockWords),
          collapse_(bvh, kConfig),
          blocksBelow_(new uint32_t[bvh.nodes.size()]) {}

    FlatTree flatten() {
        FlatTree tree;
        tree.stackEntries = count(0);
        tree.nodeCount = 1 + blocksBelow_[0];
        requireAddressable(tree.nodeCount, nodeBase_, kMaxBlocksBvh4b, bvh_.order.size(), slotBase_);
        tree.root = nodeBase_;
        tree.words.resize(size_t{tree.nodeCount} * blockWords_);
        tree.order = bvh_.order;
        emit({0, 0, 1}, tree);
        return tree;
    }

private:
    static constexpr uint32_t kParallelBlocks = 4096;
    using Node = WideNode<kWidthBvh4b>;
    using Kind = WideChild::Kind;

    /// A node to be written: its block, and where those below it begin. Without the base.
    struct Job {
        uint32_t source;
        uint32_t block;
        uint32_t next;
    };

    template <class Body>
    void forEach(uint32_t source, uint32_t size, const Body& body) const {
        if (collapse_.primitivesBelow(source) > kParallelBlocks)
            tbb::parallel_for(uint32_t{0}, size, body);
        else
            for (uint32_t i = 0; i < size; ++i) body(i);
    }

    /// Fills blocksBelow_ from `source` down. Returns the most nodes of several children on a way down: what is left of each is
    /// one group on a walk's stack.
    uint32_t count(uint32_t source) {
        const Node node = collapse_.open(source);
        std::array<uint32_t, kWidthBvh4b> levels{};
        forEach(source, node.size, [&](uint32_t i) {
            if (node.children[i].kind == Kind::inner) levels[i] = count(node.children[i].source);
        });
        uint32_t below = node.size;
        for (uint32_t i = 0; i < node.size; ++i)
            if (node.children[i].kind == Kind::inner) below += blocksBelow_[node.children[i].source];
        blocksBelow_[source] = below;
        return *std::max_element(levels.begin(), levels.end()) + (node.size > 1 ? 1 : 0);
    }

    glm::uvec4* block(uint32_t index, FlatTree& tree) const { return &tree.words[size_t{index} * blockWords_]; }

    void emit(const Job& job, FlatTree& tree) const {
        const Node node = collapse_.open(job.source);
        const NodeBvh4b encoded = encode(bvh_.nodes[job.source].bounds, node, nodeBase_ + job.next);
        std::memcpy(block(job.block, tree), &encoded, sizeof(encoded));
        std::array<Job, kWidthBvh4b> jobs{};
        uint32_t next = job.next + node.size;
        for (uint32_t i = 0; i < node.size; ++i) {
            const WideChild& child = node.children[i];
            jobs[i] = {child.source, job.next + i, next};
            if (child.kind == Kind::inner)
                next += blocksBelow_[child.source];
            else
                block(job.next + i, tree)->w = kLeafBit | (slotBase_ + bvh_.nodes[child.source].first + child.skip);
        }
        forEach(job.source, node.size, [&](uint32_t i) {
            if (node.children[i].kind == Kind::inner) emit(jobs[i], tree);
        });
    }

    static NodeBvh4b encode(const Aabb& bounds, const Node& wide, uint32_t firstChild) {
        const LocalFrame frame = localFrame(bounds);
        NodeBvh4b node{frame.origin, frame.exponents | (wide.size - 1) << 24, {}, firstChild, 0};
        for (uint32_t i = 0; i < wide.size; ++i) {
            const QuantisedBox box = quantise(frame, wide.children[i].bounds);
            for (int axis = 0; axis < 3; ++axis) {
                node.planes[2 * axis] |= box.lo[axis] << (8 * i);
                node.planes[2 * axis + 1] |= box.hi[axis] << (8 * i);
            }
        }
        return node;
    }

    const Bvh& bvh_;
    uint32_t nodeBase_;
    uint32_t slotBase_;
    uint32_t blockWords_;
    WideCollapse<kWidthBvh4b> collapse_;
    std::unique_ptr<uint32_t[]> blocksBelow_;  ///< by node of the binary tree; only of nodes that become blocks
};

}  // namespace

FlatTree flattenTreeBvh4b(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase, uint32_t blockWords) {
    if (bvh.nodes.empty()) return {};
    return BlockFlattener(bvh, nodeBase, slotBase, blockWords).flatten();
}

}  // namespace raylab
