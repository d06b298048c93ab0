#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/accel/build_binned.h"
#include "engine/accel/layout.h"
#include "engine/accel/layout_bvh8q.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/accel/walk_binary.h"
#include "engine/core/error.h"
#include "tests/unit/accel_support.h"

/// What every layout makes of a tree, decoded here from its words in double precision.
namespace raylab {
namespace {

using accel_test::kNodeBase;
using accel_test::kSlotBase;
using accel_test::Random;
using accel_test::TestMesh;

struct Box {
    glm::dvec3 lo, hi;

    double area() const {
        const glm::dvec3 e = hi - lo;
        return e.x * e.y + e.y * e.z + e.z * e.x;
    }
};

constexpr uint32_t kNoNode = 0xffffffffu;

struct Child {
    Box box;
    bool inner = false;
    uint32_t first = 0;  ///< node, or slot
    uint32_t count = 0;
    uint32_t leafNode = kNoNode;  ///< where a layout has nodes that are leaves
};

uint32_t byteOf(uint32_t word, uint32_t i) { return (word >> (8 * i)) & 255u; }

Child childOf(const Box& box, uint32_t reference) {
    if (isLeafReference(reference)) return {box, false, leafFirst(reference), leafCount(reference)};
    return {box, true, reference, 0};
}

std::vector<Child> decodeBvh2(const FlatTree&, const glm::uvec4* w) {
    const auto corner = [&](int word) { return glm::dvec3(glm::uintBitsToFloat(glm::uvec3(w[word]))); };
    return {childOf({corner(0), corner(1)}, w[0].w), childOf({corner(2), corner(3)}, w[1].w)};
}

std::vector<Child> decodeBvh2q(const FlatTree& tree, const glm::uvec4* w) {
    const auto corner = [&](int word, uint32_t shift) {
        const glm::uvec3 q = (glm::uvec3(w[word]) >> shift) & 0xffffu;
        return glm::dvec3(tree.grid.origin) + glm::dvec3(q) * glm::dvec3(tree.grid.step);
    };
    return {childOf({corner(0, 0), corner(0, 16)}, w[0].w), childOf({corner(1, 0), corner(1, 16)}, w[1].w)};
}

/// `lo` and `hi`: a byte on each axis.
Box decodeFrame(const glm::uvec4& word, const glm::uvec3& lo, const glm::uvec3& hi) {
    const glm::dvec3 origin(glm::uintBitsToFloat(glm::uvec3(word)));
    glm::dvec3 step;
    for (int axis = 0; axis < 3; ++axis) step[axis] = std::ldexp(1.0, static_cast<int>(byteOf(word.w, axis)) - 127);
    return {origin + glm::dvec3(lo) * step, origin + glm::dvec3(hi) * step};
}

std::vector<Child> decodeBvh4q(const FlatTree&, const glm::uvec4* w) {
    std::vector<Child> children;
    uint32_t node = w[2].z & 0x0fffffffu;
    uint32_t slot = w[2].w & 0x0fffffffu;
    for (uint32_t i = 0; i < 4; ++i) {
        if (((w[2].z >> (28 + i)) & 1u) == 0) continue;
        Child child;
        child.box = decodeFrame(w[0], {byteOf(w[1].x, i), byteOf(w[1].y, i), byteOf(w[1].z, i)},
                                {byteOf(w[1].w, i), byteOf(w[2].x, i), byteOf(w[2].y, i)});
        child.inner = ((w[2].w >> (28 + i)) & 1u) != 0;
        child.count = child.inner ? 0 : ((w[0].w >> (24 + 2 * i)) & 3u) + 1;
        child.first = child.inner ? node++ : slot;
        slot += child.count;
        children.push_back(child);
    }
    return children;
}

std::vector<Child> decodeBvh8q(const FlatTree&, const glm::uvec4* w) {
    std::vector<Child> children;
    uint32_t node = w[1].x;
    for (uint32_t slot = 0; slot < 8; ++slot) {
        const auto byte = [&](uint32_t low, uint32_t high) { return byteOf(slot < 4 ? low : high, slot % 4); };
        const uint32_t meta = byte(w[1].z, w[1].w);
        if (meta == 0) continue;
        Child child;
        child.box = decodeFrame(w[0], {byte(w[2].x, w[2].y), byte(w[2].z, w[2].w), byte(w[3].x, w[3].y)},
                                {byte(w[3].z, w[3].w), byte(w[4].x, w[4].y), byte(w[4].z, w[4].w)});
        child.inner = ((w[0].w >> (24 + slot)) & 1u) != 0;
        if (child.inner) {
            EXPECT_EQ(meta, 32u + 24u + slot);
            child.first = node++;
        } else {
            child.first = w[1].y + (meta & 31u);
            child.count = (meta >> 5) == 7 ? 3 : (meta >> 5) == 3 ? 2 : 1;
        }
        children.push_back(child);
    }
    return children;
}

std::vector<Child> decodeBvh4b(const FlatTree& tree, const glm::uvec4* w) {
    std::vector<Child> children;
    for (uint32_t i = 0; i <= ((w[0].w >> 24) & 3u); ++i) {
        Child child;
        child.box = decodeFrame(w[0], {byteOf(w[1].x, i), byteOf(w[1].z, i), byteOf(w[2].x, i)},
                                {byteOf(w[1].y, i), byteOf(w[1].w, i), byteOf(w[2].y, i)});
        child.first = w[2].z + i;
        const uint32_t head = tree.words.at(size_t{child.first - kNodeBase} * 3).w;
        child.inner = (head & kLeafBit) == 0;
        if (!child.inner) child = {child.box, false, head & ~kLeafBit, 1, child.first};
        children.push_back(child);
    }
    return children;
}

std::vector<Child> decode(const LayoutInfo& layout, const FlatTree& tree, uint32_t node) {
    using Decode = std::vector<Child> (*)(const FlatTree&, const glm::uvec4*);
    static const std::map<std::string_view, Decode> kDecode = {{"bvh2", decodeBvh2},
                                                               {"bvh2q", decodeBvh2q},
                                                               {"bvh4q", decodeBvh4q},
                                                               {"bvh8q", decodeBvh8q},
                                                               {"bvh4b", decodeBvh4b}};
    return kDecode.at(layout.name)(tree, &tree.words.at(size_t{node - kNodeBase} * layout.wordsPerNode));
}

struct Visited {
    std::vector<uint32_t> nodes;  ///< how often each was reached
    std::vector<uint32_t> slots;
    float largestLeaf = std::numeric_limits<float>::infinity();  ///< whose areas count
    double leafArea = 0.0;                                       ///< of the layout's leaf boxes
    double exactArea = 0.0;                                      ///< of their primitives' boxes
    double cost = 0.0;                                           ///< SAH over exact boxes, with the wide layouts' costs
};

double exactArea(const Aabb& box) { return Box{glm::dvec3(box.lo), glm::dvec3(box.hi)}.area(); }

/// Checks that each box contains the primitives below it, and returns the box of those below `node`.
Aabb visit(const LayoutInfo& layout, const FlatTree& tree, std::span<const Aabb> bounds, uint32_t node,
           Visited& visited) {
    ++visited.nodes.at(node - kNodeBase);
    Aabb all;
    for (const Child& child : decode(layout, tree, node)) {
        Aabb below;
        if (child.inner) {
            below = visit(layout, tree, bounds, child.first, visited);
        } else {
            if (child.leafNode != kNoNode) ++visited.nodes.at(child.leafNode - kNodeBase);
            for (uint32_t slot = child.first - kSlotBase; slot < child.first - kSlotBase + child.count; ++slot) {
                ++visited.slots.at(slot);
                below.grow(bounds[tree.order.at(slot)]);
            }
            const bool counts = glm::all(glm::lessThan(below.extent(), glm::vec3(visited.largestLeaf)));
            visited.leafArea += counts ? child.box.area() : 0.0;
            visited.exactArea += counts ? exactArea(below) : 0.0;
            visited.cost += 0.6 * child.count * exactArea(below);
        }
        EXPECT_TRUE(glm::all(glm::lessThanEqual(child.box.lo, glm::dvec3(below.lo)))) << layout.name;
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(child.box.hi, glm::dvec3(below.hi)))) << layout.name;
        all.grow(below);
    }
    visited.cost += exactArea(all);
    return all;
}

Visited checkFlattened(const LayoutInfo& layout, const Bvh& bvh, std::span<const Aabb> bounds) {
    const FlatTree tree = flatten(layout.name, bvh, kNodeBase, kSlotBase);
    EXPECT_EQ(tree.words.size(), size_t{tree.nodeCount} * layout.wordsPerNode);
    EXPECT_EQ(tree.root, kNodeBase);
    std::vector<uint32_t> expected = bvh.order;
    std::vector<uint32_t> actual = tree.order;
    std::sort(expected.begin(), expected.end());
    std::sort(actual.begin(), actual.end());
    EXPECT_EQ(actual, expected);
    Visited visited{std::vector<uint32_t>(tree.nodeCount), std::vector<uint32_t>(tree.order.size())};
    visit(layout, tree, bounds, tree.root, visited);
    // A binary layout holds a tree of one primitive twice.
    const uint32_t times = bvh.order.size() == 1 && visited.slots[0] == 2 ? 2 : 1;
    EXPECT_EQ(visited.nodes, std::vector<uint32_t>(tree.nodeCount, 1));
    EXPECT_EQ(visited.slots, std::vector<uint32_t>(tree.order.size(), times));
    return visited;
}

/// With leaves that the layout holds.
Bvh buildFor(const LayoutInfo& layout, std::span<const Aabb> bounds, BvhConfig config = {}) {
    config.maxLeafSize = std::min(config.maxLeafSize, layout.maxLeafSize);
    return buildBinned(bounds, config);
}

void checkAll(std::span<const Aabb> bounds, const BvhConfig& config = {}) {
    for (const LayoutInfo& layout : layouts()) checkFlattened(layout, buildFor(layout, bounds, config), bounds);
}

TEST(AccelLayouts, AreKnownByName) {
    EXPECT_THROW(flatten("bvh3", Bvh(), 0, 0), Error);
    EXPECT_GE(layoutNames().size(), 4u);
    for (const std::string& name : layoutNames()) {
        const FlatTree tree = flatten(name, Bvh(), 0, 0);
        EXPECT_EQ(tree.root, kEndOfWalk);
        EXPECT_TRUE(tree.words.empty() && tree.order.empty());
    }
}

TEST(AccelLayouts, BoxesContainTheirPrimitivesAtAnyScaleAndOffset) {
    Random random(61);
    for (int i = 0; i < 200; ++i) {
        const float scale = std::pow(10.0f, random.uniform(-6.0f, 6.0f));
        const float offset = i % 4 == 0 ? 0.0f : std::pow(10.0f, random.uniform(-6.0f, 6.0f));
        const glm::vec3 shift = random.inCube(-offset, offset);
        std::vector<Aabb> bounds;
        for (int box = 0; box < 200; ++box) {
            const glm::vec3 lo = shift + random.inCube(-scale, scale);
            bounds.push_back({lo, lo + random.inCube(0.0f, 0.1f * scale)});
        }
        BvhConfig config;
        config.maxLeafSize = 1 + i % kMaxLeafSize;
        config.traversalCost = i % 3 == 0 ? 10.0f : 1.0f;  // leaves as large as allowed
        checkAll(bounds, config);
    }
}

TEST(AccelLayouts, FlatAndExtremeTrees) {
    for (const float size : {0.0f, 1e-38f, 1e-30f, 1.0f, 1e15f})
        for (const float offset : {0.0f, 1.0f, -1e6f, 9e14f}) {
            std::vector<Aabb> bounds;
            for (int i = 0; i < 40; ++i) {
                glm::vec3 p(offset, 0.0f, -offset);
                p[i % 3] += size * static_cast<float>(i) / 40.0f;
                bounds.push_back({glm::max(p, -kLargestCoordinate), glm::min(p, kLargestCoordinate)});
            }
            checkAll(bounds);
        }
}

TEST(AccelLayouts, TreesOfOneLeaf) {
    BvhConfig config;
    config.maxLeafSize = kMaxLeafSize;
    for (uint32_t count = 1; count <= uint32_t{kMaxLeafSize}; ++count) {
        const std::vector<Aabb> bounds(count, Aabb{glm::vec3(1.0f), glm::vec3(2.0f)});
        const Bvh bvh = buildBinned(bounds, config);
        ASSERT_EQ(bvh.nodes.size(), 1u) << "one leaf is cheaper than two boxes of the same size";
        for (const LayoutInfo& layout : layouts())
            if (count <= static_cast<uint32_t>(layout.maxLeafSize)) checkFlattened(layout, bvh, bounds);
    }
}

TEST(AccelLayouts, LargeLeavesTakeSeveralChildrenOrANodeOfTheirOwn) {
    Random random(62);
    std::vector<Aabb> bounds;
    for (int cluster = 0; cluster < 50; ++cluster) {
        const glm::vec3 lo = random.inCube(-100.0f, 100.0f);
        for (uint32_t i = 0; i < 1 + random.below(16); ++i) bounds.push_back({lo, lo + 1.0f});
    }
    BvhConfig config;
    config.maxLeafSize = kMaxLeafSize;
    checkAll(bounds, config);
}

TEST(AccelLayouts, PrimitivesMayBeInSeveralLeaves) {
    const TestMesh mesh = accel_test::randomSoup(3000, 0.05f, 63);
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    for (const LayoutInfo& layout : layouts()) {
        Bvh bvh = buildFor(layout, bounds);
        for (uint32_t& id : bvh.order)
            id /= 2;  // as after spatial splits, whose leaves do not contain all of a primitive
        checkFlattened(layout, bvh, std::vector<Aabb>(3000));
    }
}

/// A detailed mesh of size 0.2 in a world a million wide.
TEST(AccelLayouts, ASmallMeshInALargeWorldKeepsItsCulling) {
    TestMesh mesh = accel_test::sphere(0.1f, 60, 120, {3.0f, -2.0f, 1.0f});
    const float wall = 5e5f;
    for (const float side : {-wall, wall}) {
        mesh.add({side, -wall, -wall}, {side, wall, -wall}, {side, wall, wall});
        mesh.add({-wall, side, -wall}, {wall, side, -wall}, {wall, side, wall});
    }
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    for (const LayoutInfo& layout : layouts()) {
        if (layout.name == "bvh2q") continue;  // one grid for all: this is what it cannot do
        const FlatTree tree = flatten(layout.name, buildFor(layout, bounds), kNodeBase, kSlotBase);
        Visited visited{std::vector<uint32_t>(tree.nodeCount), std::vector<uint32_t>(tree.order.size())};
        visited.largestLeaf = 1.0f;  // not the walls, whose area is all there is otherwise
        visit(layout, tree, bounds, tree.root, visited);
        EXPECT_GT(visited.exactArea, 0.1) << layout.name;
        EXPECT_LT(visited.leafArea, 1.25 * visited.exactArea) << layout.name;
    }
}

/// SAH cost of opening, over and over, the inner child of the largest area: what the optimum must not be above.
double greedyCost(const Bvh& bvh, uint32_t source, size_t width, uint32_t maxLeaf) {
    std::vector<uint32_t> children = {source};
    const auto isOpen = [&](uint32_t node) { return !bvh.nodes[node].isLeaf(); };
    while (children.size() < width) {
        const auto largest = std::max_element(children.begin(), children.end(), [&](uint32_t a, uint32_t b) {
            return (isOpen(a) ? exactArea(bvh.nodes[a].bounds) : -1.0) <
                   (isOpen(b) ? exactArea(bvh.nodes[b].bounds) : -1.0);
        });
        if (!isOpen(*largest)) break;
        const uint32_t left = bvh.nodes[*largest].left;
        *largest = left;
        children.push_back(left + 1);
    }
    double cost = exactArea(bvh.nodes[source].bounds);
    for (const uint32_t child : children) {
        const BvhNode& node = bvh.nodes[child];
        EXPECT_LE(node.count, maxLeaf);
        cost += node.isLeaf() ? 0.6 * node.count * exactArea(node.bounds) : greedyCost(bvh, child, width, maxLeaf);
    }
    return cost;
}

TEST(AccelLayouts, CollapsingIsBetterThanOpeningTheLargest) {
    const TestMesh mesh = accel_test::randomSoup(20000, 0.02f, 64);
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    BvhConfig config;
    config.maxLeafSize = 3;
    const Bvh bvh = buildBinned(bounds, config);
    EXPECT_LT(checkFlattened(findLayout("bvh4q"), bvh, bounds).cost, 0.99 * greedyCost(bvh, 0, 4, 4));
    EXPECT_LT(checkFlattened(findLayout("bvh8q"), bvh, bounds).cost, 0.99 * greedyCost(bvh, 0, 8, 3));
}

TEST(AccelLayouts, EightChildrenAreInOctantOrder) {
    Random random(65);
    std::vector<Aabb> bounds;
    for (uint32_t corner = 0; corner < 8; ++corner)
        for (int i = 0; i < 20; ++i) {
            const glm::vec3 lo =
                random.inCube(0.0f, 1.0f) + 10.0f * glm::vec3(corner & 1u, (corner >> 1) & 1u, (corner >> 2) & 1u);
            bounds.push_back({lo, lo + 0.1f});
        }
    const FlatTree tree = flatten("bvh8q", buildBinned(bounds), kNodeBase, kSlotBase);
    const auto root = loadNode<NodeBvh8q>(tree, 0);
    EXPECT_EQ(root.exponentsInner >> 24, 0xffu);
    const std::vector<Child> children = decode(findLayout("bvh8q"), tree, kNodeBase);
    ASSERT_EQ(children.size(), 8u);
    for (uint32_t slot = 0; slot < 8; ++slot) {
        const glm::dvec3 centre = 0.5 * (children[slot].box.lo + children[slot].box.hi);
        for (uint32_t axis = 0; axis < 3; ++axis)
            EXPECT_EQ(centre[static_cast<int>(axis)] > 5.0, ((slot >> axis) & 1u) != 0);
    }
}

TEST(AccelLayouts, AreTheSameForAnyNumberOfThreads) {
    const TestMesh mesh = accel_test::randomSoup(60000, 0.01f, 66);
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    for (const LayoutInfo& layout : layouts()) {
        const Bvh bvh = buildFor(layout, bounds);
        const FlatTree many = flatten(layout.name, bvh, 0, 0);
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        const FlatTree one = flatten(layout.name, bvh, 0, 0);
        EXPECT_EQ(many.words, one.words) << layout.name;
        EXPECT_EQ(many.order, one.order) << layout.name;
        EXPECT_EQ(many.stackEntries, one.stackEntries);
    }
}

TEST(AccelLayouts, RefuseWhatReferencesCannotHold) {
    const std::vector<Aabb> bounds(100, Aabb{glm::vec3(0.0f), glm::vec3(1.0f)});
    const std::map<std::string_view, uint32_t> lastNode = {{"bvh2", 0x7ffffff0u},
                                                           {"bvh2q", 0x7ffffff0u},
                                                           {"bvh4q", (1u << 25) - 2},
                                                           {"bvh8q", 0xfffffffeu},
                                                           {"bvh4b", (1u << 25) - 2}};
    for (const LayoutInfo& layout : layouts()) {
        const Bvh bvh = buildFor(layout, bounds);
        EXPECT_THROW(flatten(layout.name, bvh, lastNode.at(layout.name), 0), Error) << layout.name;
        EXPECT_THROW(flatten(layout.name, bvh, 0, (1u << 27) - 50u), Error) << layout.name;
        EXPECT_NO_THROW(flatten(layout.name, bvh, 0, (1u << 27) - 100u)) << layout.name;
    }
}

}  // namespace
}  // namespace raylab
