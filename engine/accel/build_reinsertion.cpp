#include "engine/accel/build_reinsertion.h"

#include "engine/accel/build_range.h"

namespace raylab {
namespace {

float halfAreaOfBoth(const Box4& a, const Box4& b) {
    Box4 both = a;
    both.grow(b);
    return both.halfArea();
}

}  // namespace

ReinsertionTree::ReinsertionTree(const Bvh& bvh) : nodes_(bvh.nodes.size()) {
    for (uint32_t i = 0; i < nodes_.size(); ++i) {
        const BvhNode& node = bvh.nodes[i];
        nodes_[i].box = toBox4(node.bounds);
        if (node.isLeaf()) continue;
        nodes_[i].left = node.left;
        nodes_[i].right = node.left + 1;
        nodes_[node.left].parent = nodes_[node.left + 1].parent = i;
    }
}

double ReinsertionTree::innerArea() const {
    double sum = 0.0;
    for (const Node& node : nodes_)
        if (!node.isLeaf()) sum += static_cast<double>(node.box.halfArea());
    return sum;
}

/// The root and its children stay.
bool ReinsertionTree::mayMove(uint32_t node) const { return node != 0 && nodes_[node].parent != 0; }

bool ReinsertionTree::isBelow(uint32_t node, uint32_t ancestor) const {
    while (node != kNoNode && node != ancestor) node = nodes_[node].parent;
    return node == ancestor;
}

uint32_t ReinsertionTree::siblingOf(uint32_t node) const {
    const Node& parent = nodes_[nodes_[node].parent];
    return parent.left == node ? parent.right : parent.left;
}

/// Taking the node out saves its parent, and shrinks the ancestors up to the pivot, below which it is put in again: its
/// box changes nothing from the pivot on. Below the other child of the pivot, each node on the way grows by the node,
/// and the new parent costs the box of both.
Reinsertion ReinsertionTree::search(uint32_t node, std::vector<std::pair<uint32_t, float>>& stack) const {
    Reinsertion best{node, kNoNode, 0.0f};
    if (!mayMove(node)) return best;
    const Box4 box = nodes_[node].box;
    const float area = box.halfArea();
    const auto consider = [&](uint32_t target, float gain) {
        if (gain > best.gain) best = {node, target, gain};
    };
    uint32_t pivot = nodes_[node].parent;
    uint32_t from = node;
    float saved = nodes_[pivot].box.halfArea();
    Box4 rest = nodes_[siblingOf(node)].box;  // of what stays below the pivot
    while (true) {
        stack.assign(1, {siblingOf(from), saved});
        while (!stack.empty()) {
            const auto [target, savedAbove] = stack.back();
            stack.pop_back();
            if (savedAbove - area <= best.gain) continue;  // the new parent costs `area` at least
            const Node& place = nodes_[target];
            const float gain = savedAbove - halfAreaOfBoth(place.box, box);
            consider(target, gain);
            if (place.isLeaf()) continue;
            const float savedBelow = gain + place.box.halfArea();
            stack.emplace_back(place.left, savedBelow);
            stack.emplace_back(place.right, savedBelow);
        }
        if (pivot == 0) return best;
        if (from != node) {
            rest.grow(nodes_[siblingOf(from)].box);
            saved += nodes_[pivot].box.halfArea() - rest.halfArea();
            consider(pivot, saved - nodes_[pivot].box.halfArea());
        }
        from = pivot;
        pivot = nodes_[pivot].parent;
    }
}

void ReinsertionTree::replaceChild(uint32_t parent, uint32_t child, uint32_t by) {
    (nodes_[parent].left == child ? nodes_[parent].left : nodes_[parent].right) = by;
    nodes_[by].parent = parent;
}

double ReinsertionTree::refitUp(uint32_t node) {
    double growth = 0.0;
    for (; node != kNoNode; node = nodes_[node].parent) {
        Box4 box = nodes_[nodes_[node].left].box;
        box.grow(nodes_[nodes_[node].right].box);
        const Aabb before = toAabb(nodes_[node].box);
        const Aabb after = toAabb(box);
        if (before.lo == after.lo && before.hi == after.hi) break;
        growth += static_cast<double>(after.halfArea()) - static_cast<double>(before.halfArea());
        nodes_[node].box = box;
    }
    return growth;
}

/// The parent goes with the node: out of the tree, its box counts as nothing.
double ReinsertionTree::move(uint32_t node, uint32_t target) {
    const uint32_t parent = nodes_[node].parent;
    const uint32_t grandparent = nodes_[parent].parent;
    double growth = -static_cast<double>(nodes_[parent].box.halfArea());
    replaceChild(grandparent, parent, siblingOf(node));
    growth += refitUp(grandparent);
    replaceChild(nodes_[target].parent, target, parent);
    nodes_[parent].left = target;
    nodes_[parent].right = node;
    nodes_[target].parent = parent;
    nodes_[parent].box = nodes_[target].box;
    nodes_[parent].box.grow(nodes_[node].box);
    growth += static_cast<double>(nodes_[parent].box.halfArea());
    return growth + refitUp(nodes_[parent].parent);
}

double ReinsertionTree::apply(const Reinsertion& reinsertion) {
    const auto [node, target, gain] = reinsertion;
    if (target == kNoNode || target == 0 || !mayMove(node) || target == nodes_[node].parent) return 0.0;
    const uint32_t sibling = siblingOf(node);
    if (target == sibling || isBelow(target, node)) return 0.0;
    const double growth = move(node, target);
    if (growth < 0.0) return -growth;
    move(node, sibling);
    return 0.0;
}

}  // namespace raylab
