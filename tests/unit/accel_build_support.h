#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "engine/accel/build_input.h"
#include "engine/accel/bvh.h"
#include "engine/accel/triangle_bounds.h"
#include "tests/unit/accel_support.h"

namespace raylab::accel_test {

/// Whether trees of the builder may list a triangle more than once.
inline bool mayListAgain(std::string_view builder) { return builder == "spatial" || builder == "auto"; }

inline std::vector<Aabb> boundsOf(const TestMesh& mesh) { return triangleBounds(mesh.positions, mesh.triangles); }

inline BuildInput inputOf(const TestMesh& mesh, const std::vector<Aabb>& bounds) {
    return {bounds, mesh.positions, mesh.triangles};
}

inline Aabb cube(const glm::vec3& center, float halfSize) { return {center - halfSize, center + halfSize}; }

/// A triangle in each box that touches all its faces, so that its box is the same.
inline TestMesh trianglesIn(std::span<const Aabb> boxes) {
    TestMesh mesh;
    for (const Aabb& box : boxes) mesh.add(box.lo, {box.hi.x, box.hi.y, box.lo.z}, {box.lo.x, box.hi.y, box.hi.z});
    return mesh;
}

/// Beams along the diagonal of the unit cube, half as long as that, among twenty times as many small triangles: the box
/// of each beam is mostly empty and full of others.
inline TestMesh longDiagonals(size_t beams, uint32_t seed) {
    TestMesh mesh = randomSoup(20 * beams, 0.01f, seed);
    Random random(seed + 1);
    for (size_t i = 0; i < beams; ++i) {
        const glm::vec3 p = random.inCube(0.0f, 1.0f);
        mesh.add(p, p + glm::vec3(0.5f), p + 0.002f * random.direction());
    }
    return mesh;
}

/// Walks a tree in the order that bvh.h documents and checks it against the primitives themselves.
class TreeCheck {
public:
    /// `tight`: leaf boxes are those of their primitives; otherwise they are inside of that, and tightness is not
    /// checked.
    TreeCheck(const Bvh& bvh, std::span<const Aabb> bounds, const BvhConfig& config, bool tight)
        : bvh_(bvh), bounds_(bounds), config_(config), tight_(tight) {}

    void run() {
        std::vector<uint32_t> usable;
        for (uint32_t i = 0; i < bounds_.size(); ++i)
            if (bounds_[i].usable()) usable.push_back(i);
        std::vector<uint32_t> ids = bvh_.order;
        std::sort(ids.begin(), ids.end());
        if (!tight_) ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        ASSERT_EQ(ids, usable);
        EXPECT_EQ(bvh_.skipped, bounds_.size() - usable.size());
        EXPECT_EQ(usable.empty() ? 0 : subtree(0), bvh_.depth);
        EXPECT_EQ(nextNode_, usable.empty() ? 1 : bvh_.nodes.size());
        EXPECT_EQ(nextSlot_, bvh_.order.size());
        EXPECT_LE(bvh_.depth, static_cast<uint32_t>(config_.maxDepth));
    }

private:
    /// Returns the height.
    uint32_t subtree(uint32_t index) {
        const BvhNode& node = bvh_.nodes.at(index);
        if (node.isLeaf()) {
            leaf(node);
            return 0;
        }
        EXPECT_EQ(node.left, nextNode_);
        nextNode_ += 2;
        const uint32_t left = subtree(node.left);
        const uint32_t right = subtree(node.left + 1);
        Aabb box = bvh_.nodes[node.left].bounds;
        box.grow(bvh_.nodes[node.left + 1].bounds);
        EXPECT_EQ(node.bounds.lo, box.lo);
        EXPECT_EQ(node.bounds.hi, box.hi);
        return 1 + std::max(left, right);
    }
    void leaf(const BvhNode& node) {
        EXPECT_EQ(node.first, nextSlot_);
        nextSlot_ += node.count;
        EXPECT_LE(node.count, static_cast<uint32_t>(config_.maxLeafSize));
        Aabb box;
        for (uint32_t slot = node.first; slot < node.first + node.count; ++slot) {
            box.grow(bounds_[bvh_.order.at(slot)]);
            for (uint32_t other = node.first; other < slot; ++other)
                EXPECT_NE(bvh_.order[slot], bvh_.order[other]) << "twice in one leaf";
        }
        EXPECT_TRUE(!tight_ || node.bounds.contains(box));
        EXPECT_TRUE(box.contains(node.bounds));
        EXPECT_FALSE(node.bounds.empty());
    }

    const Bvh& bvh_;
    std::span<const Aabb> bounds_;
    const BvhConfig& config_;
    bool tight_;
    size_t nextNode_ = 1;
    size_t nextSlot_ = 0;
};

inline void checkTree(const Bvh& bvh, std::span<const Aabb> bounds, const BvhConfig& config = {}, bool tight = true) {
    TreeCheck(bvh, bounds, config, tight).run();
}

inline void expectSameBytes(const Bvh& a, const Bvh& b) {
    EXPECT_EQ(a.order, b.order);
    EXPECT_EQ(a.depth, b.depth);
    EXPECT_EQ(a.skipped, b.skipped);
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    EXPECT_EQ(0, std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)));
}

/// Samples points of each triangle: each lies in the box of a leaf that lists the triangle, but for `slack`.
inline void checkCover(const Bvh& bvh, const TestMesh& mesh, size_t points, double slack, uint32_t seed) {
    std::vector<std::vector<Aabb>> boxesOf(mesh.triangles.size());
    for (const BvhNode& node : bvh.nodes)
        for (uint32_t slot = node.first; slot < node.first + node.count; ++slot)
            boxesOf[bvh.order[slot]].push_back(node.bounds);
    Random random(seed);
    size_t outside = 0;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& triangle = mesh.triangles[i];
        const glm::dvec3 p0(mesh.positions[triangle.x]);
        for (size_t k = 0; k < points && !boxesOf[i].empty(); ++k) {
            const double u = static_cast<double>(random.uniform(0.0f, 1.0f));
            const double v = (1.0 - u) * static_cast<double>(random.uniform(0.0f, 1.0f));
            const glm::dvec3 p = p0 + u * (glm::dvec3(mesh.positions[triangle.y]) - p0) +
                                 v * (glm::dvec3(mesh.positions[triangle.z]) - p0);
            outside += std::none_of(boxesOf[i].begin(), boxesOf[i].end(), [&](const Aabb& box) {
                return glm::all(glm::greaterThanEqual(p, glm::dvec3(box.lo) - slack)) &&
                       glm::all(glm::lessThanEqual(p, glm::dvec3(box.hi) + slack));
            });
        }
    }
    EXPECT_EQ(outside, 0u);
}

}  // namespace raylab::accel_test
