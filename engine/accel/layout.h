#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/accel/bvh.h"

namespace raylab {

/// Positions as 16-bit integers: coordinate = origin + q * step. The step is positive on each axis, of flat trees too.
struct Grid {
    glm::vec3 origin{0.0f};
    glm::vec3 step{1.0f};
};

constexpr uint32_t kLeafBit = 0x80000000u;
/// A reference that no tree contains (a leaf of 16 slots at the very end of the range): nothing to walk.
constexpr uint32_t kEndOfWalk = 0xffffffffu;

/// Bit 31 set, bits 27 to 30 count - 1, bits 0 to 26 the first primitive slot. Without bit 31: the index of a node.
constexpr uint32_t leafReference(uint32_t first, uint32_t count) { return kLeafBit | ((count - 1) << 27) | first; }
constexpr bool isLeafReference(uint32_t reference) { return (reference & kLeafBit) != 0; }
constexpr uint32_t leafFirst(uint32_t reference) { return reference & 0x07ffffffu; }
constexpr uint32_t leafCount(uint32_t reference) { return ((reference >> 27) & 15u) + 1; }

/// A tree as a kernel walks it, in any of layouts().
struct FlatTree {
    std::vector<glm::uvec4> words;  ///< what the kernel fetches: LayoutInfo::wordsPerNode a node
    Grid grid;                      ///< bvh2q only
    uint32_t root = kEndOfWalk;     ///< reference that the walk starts with; kEndOfWalk without primitives
    uint32_t nodeCount = 0;
    uint32_t stackEntries = 0;    ///< that a walk of this tree can fill at most, in uints
    std::vector<uint32_t> order;  ///< primitive ids by slot: what a leaf's slots count in
};

struct LayoutInfo {
    std::string_view name;
    std::string_view help;
    uint32_t wordsPerNode;
    /// Stack entries of a kernel besides those of the trees: the bottom, a write past the top, and what is left of an
    /// upper tree's leaf while one of its instances is walked. All: this + the upper tree's + the deepest lower tree's.
    uint32_t kernelStackEntries;
    int maxLeafSize;  ///< primitives in a leaf of the binary tree at most
    bool gridOverTree;  ///< boxes are quantised on a grid over the whole tree
    bool blocks;      ///< primitives stand among the nodes: see layout_bvh4b.h
};

/// Every layout that flatten() knows.
std::span<const LayoutInfo> layouts();
std::vector<std::string> layoutNames();
/// Throws Error where there is none of that name.
const LayoutInfo& findLayout(std::string_view name);

/// Flattens a binary tree. References in it are absolute: `nodeBase` and `slotBase` are where its first node (counted
/// in nodes of this layout) and order[0] will be. Leaves hold up to kMaxLeafSize primitives. The result does not depend
/// on the number of threads. Throws Error for a layout that is not in layouts(), and where references do not fit.
FlatTree flatten(std::string_view layout, const Bvh& bvh, uint32_t nodeBase, uint32_t slotBase);

/// Throws Error unless `nodes` of a layout and the primitives of a tree can be addressed from these bases on.
void requireAddressable(uint64_t nodes, uint32_t nodeBase, uint64_t nodeLimit, uint64_t slots, uint32_t slotBase);

}  // namespace raylab
