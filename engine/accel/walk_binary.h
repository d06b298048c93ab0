#pragma once

#include <algorithm>
#include <cassert>
#include <cstring>
#include <iterator>

#include "engine/accel/layout.h"
#include "engine/accel/walk_slab.h"

namespace raylab {

/// What a ray meets in a binary node.
struct BinaryStep {
    bool hit0, hit1;
    float t0, t1;  ///< where it enters the boxes
    uint32_t child0, child1;
};

/// Walks a binary tree near child first and calls `leaf(first, count)` for the leaves that the ray reaches.
/// `step(reference)` tests the children of a node. Returns the largest number of references on the stack.
template <class StepFn, class LeafFn>
uint32_t walkBinary(uint32_t root, const StepFn& step, LeafFn&& leaf) {
    uint32_t stack[kMaxBvhDepth + 2];
    uint32_t size = 0;
    uint32_t highWater = 0;
    uint32_t reference = root;
    while (true) {
        if (!isLeafReference(reference)) {
            const BinaryStep node = step(reference);
            reference = node.hit0 && (!node.hit1 || node.t0 <= node.t1) ? node.child0 : node.child1;
            if (node.hit0 && node.hit1) {
                assert(size < std::size(stack));
                stack[size++] = reference == node.child0 ? node.child1 : node.child0;
                highWater = std::max(highWater, size);
            }
            if (node.hit0 || node.hit1) continue;
        } else {
            leaf(leafFirst(reference), leafCount(reference));
        }
        if (size == 0) return highWater;
        reference = stack[--size];
    }
}

/// Node `index` of a flat tree, in the layout's own form.
template <class Node>
Node loadNode(const FlatTree& tree, uint32_t index) {
    Node node;
    std::memcpy(&node, &tree.words[size_t{index} * (sizeof(Node) / sizeof(glm::uvec4))], sizeof(Node));
    return node;
}

}  // namespace raylab
