#include "engine/accel/build_links.h"

#include <algorithm>

#include "engine/accel/build_parallel.h"

namespace raylab {
namespace {

void summarise(const LinkedTree& tree, LinkedNode& node) {
    const LinkedSummary left = tree.summaryOf(node.left);
    const LinkedSummary right = tree.summaryOf(node.right);
    LinkedSummary& sum = node.summary;
    sum.primitives = left.primitives + right.primitives;
    const float area = node.bounds.halfArea();
    const float leafCost = tree.config.intersectionCost * static_cast<float>(sum.primitives) * area;
    sum.cost = tree.config.traversalCost * area + left.cost + right.cost;
    if (node.forcedLeaf || (sum.primitives <= tree.maxLeafSize && leafCost <= sum.cost)) {
        sum.cost = leafCost;
        sum.below = sum.height = 0;
    } else {
        sum.below = 2 + left.below + right.below;
        sum.height = 1 + std::max(left.height, right.height);
    }
}

bool isLeaf(const LinkedTree& tree, uint32_t child) { return tree.summaryOf(child).below == 0; }

/// visit(child) for each node and unit below, from left to right and from the top.
template <class Visit>
void forEachBelow(const LinkedTree& tree, uint32_t top, const Visit& visit) {
    std::vector<uint32_t> stack = {top};
    while (!stack.empty()) {
        const uint32_t child = stack.back();
        stack.pop_back();
        visit(child);
        if (tree.isUnit(child)) continue;
        stack.push_back(tree.node(child).right);
        stack.push_back(tree.node(child).left);
    }
}

/// Builds a subtree again as halves of its units, with the nodes that it has.
class Rebalance {
public:
    Rebalance(LinkedTree& tree, uint32_t top) : tree_(tree) {
        forEachBelow(tree, top, [this](uint32_t child) { (tree_.isUnit(child) ? units_ : nodes_).push_back(child); });
        std::sort(nodes_.begin(), nodes_.end());
        build(0, units_.size());
    }

private:
    /// A node gets a higher index than everything below it, so the top keeps its own.
    uint32_t build(size_t begin, size_t end) {
        if (end - begin == 1) return units_[begin];
        const size_t middle = begin + (end - begin) / 2;
        const uint32_t left = build(begin, middle);
        const uint32_t right = build(middle, end);
        LinkedNode& node = tree_.node(nodes_[next_]);
        node.left = left;
        node.right = right;
        node.bounds = tree_.boundsOf(left);
        node.bounds.grow(tree_.boundsOf(right));
        node.forcedLeaf = end - begin <= tree_.unitsPerLeaf;
        return nodes_[next_++];
    }

    LinkedTree& tree_;
    std::vector<uint32_t> units_;
    std::vector<uint32_t> nodes_;
    size_t next_ = 0;
};

class DepthLimit {
public:
    explicit DepthLimit(LinkedTree& tree) : tree_(tree), unitsBelow_(tree.innerCount()) {
        for (size_t i = 0; i < unitsBelow_.size(); ++i)
            unitsBelow_[i] = unitsOf(tree.inner[i].left) + unitsOf(tree.inner[i].right);
    }
    void apply(uint32_t top, int levels) const {
        if (tree_.summaryOf(top).height <= static_cast<uint32_t>(levels)) return;
        const uint32_t left = tree_.node(top).left;
        const uint32_t right = tree_.node(top).right;
        if (!fitsBelow(std::max(unitsOf(left), unitsOf(right)), levels - 1)) {
            const Rebalance rebalanced(tree_, top);
            return;
        }
        apply(left, levels - 1);
        apply(right, levels - 1);
    }

private:
    size_t unitsOf(uint32_t child) const { return tree_.isUnit(child) ? 1 : unitsBelow_[child - tree_.unitCount]; }
    bool fitsBelow(size_t units, int levels) const {
        return levels >= 0 && units <= tree_.unitsPerLeaf << std::min(levels, 40);
    }

    LinkedTree& tree_;
    std::vector<size_t> unitsBelow_;
};

void limitDepth(LinkedTree& tree, uint32_t root) {
    if (tree.summaryOf(root).height <= static_cast<uint32_t>(tree.maxDepth)) return;
    DepthLimit(tree).apply(root, tree.maxDepth);
    for (size_t i = 0; i < tree.innerCount(); ++i) summarise(tree, tree.inner[i]);
}

struct Writer {
    const LinkedTree& tree;
    Bvh& bvh;

    /// Into nodes[slot], nodes from `below` on, order from `first` on.
    void write(uint32_t child, size_t slot, size_t below, uint32_t first) const {
        BvhNode& node = bvh.nodes[slot];
        node.bounds = tree.boundsOf(child);
        if (isLeaf(tree, child)) {
            node.first = first;
            node.count = tree.summaryOf(child).primitives;
            writeIds(child, first);
            return;
        }
        node.left = static_cast<uint32_t>(below);
        const uint32_t left = tree.node(child).left;
        const uint32_t right = tree.node(child).right;
        const LinkedSummary ofLeft = tree.summaryOf(left);
        const auto writeLeft = [=, this] { write(left, below, below + 2, first); };
        const auto writeRight = [=, this] {
            write(right, below + 1, below + 2 + ofLeft.below, first + ofLeft.primitives);
        };
        if (tree.summaryOf(child).below > kSubtree) {
            parallelInvoke(writeLeft, writeRight);
        } else {
            writeLeft();
            writeRight();
        }
    }
    uint32_t writeIds(uint32_t child, uint32_t first) const {
        if (!tree.isUnit(child)) return writeIds(tree.node(child).right, writeIds(tree.node(child).left, first));
        const LinkedUnit& unit = tree.units[child];
        std::copy_n(tree.ids.begin() + unit.first, unit.count, bvh.order.begin() + first);
        return first + unit.count;
    }
};

}  // namespace

LinkedTree::LinkedTree(size_t unitCount_, std::span<const uint32_t> ids_, const BvhConfig& config_)
    : units(std::make_unique_for_overwrite<LinkedUnit[]>(unitCount_)),
      inner(std::make_unique_for_overwrite<LinkedNode[]>(unitCount_ - 1)),
      unitCount(unitCount_),
      ids(ids_),
      config(config_),
      maxLeafSize(static_cast<uint32_t>(config_.maxLeafSize)),
      maxDepth(config_.maxDepth),
      unitsPerLeaf(maxLeafSize) {}

void LinkedTree::join(size_t index, uint32_t left, uint32_t right) {
    LinkedNode& node = inner[index];
    node.left = left;
    node.right = right;
    node.bounds = boundsOf(left);
    node.bounds.grow(boundsOf(right));
    node.forcedLeaf = false;
    summarise(*this, node);
}

Bvh toBvh(LinkedTree& tree) {
    const auto root = static_cast<uint32_t>(tree.unitCount + tree.innerCount() - 1);
    limitDepth(tree, root);
    const LinkedSummary sum = tree.summaryOf(root);
    Bvh bvh;
    bvh.nodes.resize(1 + sum.below);
    bvh.order.resize(sum.primitives);
    bvh.depth = sum.height;
    Writer{tree, bvh}.write(root, 0, 1, 0);
    return bvh;
}

}  // namespace raylab
