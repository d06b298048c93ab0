#include "engine/accel/layout.h"

#include <array>

#include "engine/accel/layout_bvh2.h"
#include "engine/accel/layout_bvh2q.h"
#include "engine/accel/layout_bvh4b.h"
#include "engine/accel/layout_bvh4q.h"
#include "engine/accel/layout_bvh8q.h"
#include "engine/core/error.h"

namespace raylab {
namespace {

using FlattenFunction = FlatTree (*)(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase);

FlatTree flattenBlocks(const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase) {
    return flattenTreeBvh4b(bvh, nodeBase, slotBase);
}

constexpr std::array kLayouts = {
    LayoutInfo{"bvh2", "binary, 64-byte nodes: both children's boxes as floats", 4, 2, kMaxLeafSize, false, false},
    LayoutInfo{"bvh2q", "binary, 32-byte nodes: boxes of 16 bits on a grid of the tree", 2, 2, kMaxLeafSize, true, false},
    LayoutInfo{"bvh4q", "4-wide, 48-byte nodes: boxes of 8 bits in a frame of the node", 3, 7, kMaxLeafSize, false, false},
    LayoutInfo{"bvh8q", "8-wide, 80-byte nodes in octant order: boxes of 8 bits in a frame of the node", 5, 8, kMaxLeafSize, false, false},
    LayoutInfo{"bvh4b", "4-wide, 48-byte blocks that are a node or a triangle, fetched in the same step", kWordsBvh4b, 2, 1, false, true},
};
constexpr std::array<FlattenFunction, kLayouts.size()> kFlatten = {flattenTreeBvh2, flattenTreeBvh2q, flattenTreeBvh4q,
                                                                   flattenTreeBvh8q, flattenBlocks};

}  // namespace

std::span<const LayoutInfo> layouts() { return kLayouts; }

std::vector<std::string> layoutNames() {
    std::vector<std::string> names;
    for (const LayoutInfo& info : kLayouts) names.emplace_back(info.name);
    return names;
}

const LayoutInfo& findLayout(std::string_view name) {
    for (const LayoutInfo& info : kLayouts)
        if (info.name == name) return info;
    throw Error("there is no layout '" + std::string(name) + "'");
}

FlatTree flatten(std::string_view layout, const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase) {
    for (size_t i = 0; i < kLayouts.size(); ++i)
        if (kLayouts[i].name == layout) return kFlatten[i](bvh, nodeBase, slotBase);
    throw Error("there is no layout '" + std::string(layout) + "'");
}

void requireAddressable(uint64_t nodes, uint32_t nodeBase, uint64_t nodeLimit, uint64_t slots, uint32_t slotBase) {
    if (nodeBase + nodes > nodeLimit)
        throw Error("BVH: more than " + std::to_string(nodeLimit) +
                    " nodes in all trees together; use fewer or smaller meshes");
    if (slotBase + slots > kMaxBvhPrimitives)
        throw Error("BVH: more than " + std::to_string(kMaxBvhPrimitives) +
                    " primitives in all trees together; use fewer or smaller meshes");
}

}  // namespace raylab
