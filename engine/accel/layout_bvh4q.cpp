#include "engine/accel/layout_bvh4q.h"

#include <algorithm>
#include <cstring>

#include "engine/accel/layout_wide.h"

namespace raylab {
namespace {

struct Layout4 {
    static constexpr int kWidth = kWidthBvh4q;
    static constexpr int kWords = 3;
    static constexpr WideConfig kConfig{4, 1.0f, 0.6f};

    static void arrange(const Aabb&, WideNode<kWidth>& node) {
        std::stable_partition(node.children.begin(), node.children.begin() + node.size,
                              [](const WideChild& child) { return child.kind == WideChild::Kind::inner; });
    }

    static void encode(const Aabb& bounds, const WideNode<kWidth>& wide, WidePlace place, glm::uvec4* words) {
        const LocalFrame frame = localFrame(bounds);
        NodeBvh4q node{frame.origin, frame.exponents, {}, {}, place.firstChild, place.firstSlot};
        for (uint32_t i = 0; i < wide.size; ++i) {
            const WideChild& child = wide.children[i];
            const QuantisedBox box = quantise(frame, child.bounds);
            for (int axis = 0; axis < 3; ++axis) {
                node.lo[axis] |= box.lo[axis] << (8 * i);
                node.hi[axis] |= box.hi[axis] << (8 * i);
            }
            node.childExists |= 1u << (28 + i);
            if (child.kind == WideChild::Kind::inner)
                node.slotInner |= 1u << (28 + i);
            else
                node.exponents |= (child.count - 1) << (24 + 2 * i);
        }
        std::memcpy(words, &node, sizeof(node));
    }
};

}  // namespace

FlatTree flattenTreeBvh4q(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase) {
    if (bvh.nodes.empty()) return {};
    return WideFlattener<Layout4>(bvh, nodeBase, slotBase).flatten(kMaxNodesBvh4q);
}

}  // namespace raylab
