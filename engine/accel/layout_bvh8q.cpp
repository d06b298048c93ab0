#include "engine/accel/layout_bvh8q.h"

#include <array>
#include <cstring>
#include <utility>

#include "engine/accel/layout_wide.h"

namespace raylab {
namespace {

constexpr int kSlots = kWidthBvh8q;

/// costs[slot] of a child: how late a ray meets it that goes the slot's way (Ylitie et al. 2017, section 3.3).
using SlotCosts = std::array<float, kSlots>;

SlotCosts slotCosts(const glm::vec3& fromCentre) {
    SlotCosts costs;
    for (int slot = 0; slot < kSlots; ++slot)
        costs[slot] = ((slot & 1) != 0 ? -fromCentre.x : fromCentre.x) +
                      ((slot & 2) != 0 ? -fromCentre.y : fromCentre.y) +
                      ((slot & 4) != 0 ? -fromCentre.z : fromCentre.z);
    return costs;
}

struct Layout8 {
    static constexpr int kWidth = kSlots;
    static constexpr int kWords = 5;
    static constexpr WideConfig kConfig{3, 1.0f, 0.6f};

    /// Gives each child its slot. Instead of the paper's auction: swaps of two slots, an empty one included, while one
    /// lowers the sum of the costs; two or three rounds do, and rounding must not make it go on for ever.
    static void arrange(const Aabb& bounds, WideNode<kWidth>& node) {
        std::array<SlotCosts, kSlots> costs{};  // of what is in each slot
        for (uint32_t i = 0; i < node.size; ++i)
            costs[i] = slotCosts(node.children[i].bounds.centroid() - bounds.centroid());
        bool swapped = true;
        for (int round = 0; round < kSlots && swapped; ++round) {
            swapped = false;
            for (int a = 0; a < kSlots; ++a)
                for (int b = a + 1; b < kSlots; ++b)
                    if (costs[b][a] + costs[a][b] < costs[a][a] + costs[b][b]) {
                        std::swap(costs[a], costs[b]);
                        std::swap(node.children[a], node.children[b]);
                        swapped = true;
                    }
        }
    }

    static void encode(const Aabb& bounds, const WideNode<kWidth>& wide, WidePlace place, glm::uvec4* words) {
        const LocalFrame frame = localFrame(bounds);
        NodeBvh8q node{frame.origin, frame.exponents, place.firstChild, place.firstSlot, {}, {}, {}, {}, {}, {}, {}};
        uint32_t primitives = 0;
        for (uint32_t slot = 0; slot < kSlots; ++slot) {
            const WideChild& child = wide.children[slot];
            if (child.kind == WideChild::Kind::empty) continue;
            if (child.kind == WideChild::Kind::inner) {
                node.exponentsInner |= 1u << (24 + slot);
                setByte(node.meta, slot, (1u << 5) | (24 + slot));
            } else {
                setByte(node.meta, slot, (((1u << child.count) - 1) << 5) | primitives);
                primitives += child.count;
            }
            const QuantisedBox box = quantise(frame, child.bounds);
            setByte(node.loX, slot, box.lo.x);
            setByte(node.loY, slot, box.lo.y);
            setByte(node.loZ, slot, box.lo.z);
            setByte(node.hiX, slot, box.hi.x);
            setByte(node.hiY, slot, box.hi.y);
            setByte(node.hiZ, slot, box.hi.z);
        }
        std::memcpy(words, &node, sizeof(node));
    }

private:
    static void setByte(uint32_t (&words)[2], uint32_t slot, uint32_t value) {
        words[slot / 4] |= value << (8 * (slot % 4));
    }
};

}  // namespace

FlatTree flattenTreeBvh8q(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase) {
    if (bvh.nodes.empty()) return {};
    FlatTree tree = WideFlattener<Layout8>(bvh, nodeBase, slotBase).flatten(uint64_t{1} << 32);
    tree.stackEntries *= 2;  // a group is two uints
    return tree;
}

}  // namespace raylab
