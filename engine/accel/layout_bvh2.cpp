#include "engine/accel/layout_bvh2.h"

#include "engine/accel/layout_binary.h"
#include "engine/accel/layout_frame.h"

namespace raylab {

FlatTree flattenTreeBvh2(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase) {
    FlatTree tree;
    if (bvh.nodes.empty()) return tree;
    const auto makeNode = [](const Aabb& box0, const Aabb& box1, uint32_t child0, uint32_t child1) {
        const Aabb padded0 = paddedBox(box0);
        const Aabb padded1 = paddedBox(box1);
        return NodeBvh2{padded0.lo, child0, padded0.hi, child1, padded1.lo, 0, padded1.hi, 0};
    };
    flattenBinary<NodeBvh2>(bvh, nodeBase, slotBase, makeNode, tree.words);
    finishBinary<NodeBvh2>(bvh, nodeBase, tree);
    return tree;
}

}  // namespace raylab
