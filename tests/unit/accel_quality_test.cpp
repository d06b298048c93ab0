#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/accel/builders.h"
#include "engine/accel/quality.h"
#include "engine/accel/triangle_bounds.h"
#include "tests/unit/accel_support.h"

namespace raylab {
namespace {

using accel_test::Random;
using accel_test::TestMesh;

/// A root over two leaves of one triangle each.
Bvh twoLeaves(const Aabb& left, const Aabb& right) {
    Aabb root = left;
    root.grow(right);
    Bvh bvh;
    bvh.nodes = {{root, 1, 0, 0}, {left, 0, 0, 1}, {right, 0, 1, 1}};
    bvh.order = {0, 1};
    bvh.depth = 1;
    return bvh;
}

TEST(AccelQuality, SahOfTwoLeavesByHand) {
    // Cubes of edge 1 and 2 in a box of 4 x 2 x 2: half areas 3, 12, 20.
    const Bvh bvh =
        twoLeaves({glm::vec3(0.0f), glm::vec3(1.0f)}, {glm::vec3(2.0f, 0.0f, 0.0f), glm::vec3(4.0f, 2.0f, 2.0f)});
    BvhConfig config;
    config.traversalCost = 3.0f;
    config.intersectionCost = 5.0f;
    const BvhQuality quality = measureQuality(bvh, config);
    EXPECT_DOUBLE_EQ(quality.sah, 3.0 + 5.0 * (3.0 + 12.0) / 20.0);
    EXPECT_EQ(quality.nodes, 3u);
    EXPECT_EQ(quality.leaves, 2u);
    EXPECT_EQ(quality.depth, 1);
    EXPECT_DOUBLE_EQ(quality.meanLeafSize, 1.0);
    EXPECT_EQ(quality.leafSizeHistogram, (std::vector<uint32_t>{0, 2}));
    EXPECT_EQ(quality.depthHistogram, (std::vector<uint32_t>{0, 2}));
    EXPECT_TRUE(std::isnan(quality.epo));
}

TEST(AccelQuality, EpoOfTwoLeavesByHand) {
    // A right triangle with legs of 4 at z = 0 (area 8), and one whose box is [0, 1]^3 (area sqrt(3) / 2): the first
    // one's corner reaches into that box with the whole unit square, the second one lies in the first one's flat box
    // with an edge, which has no area.
    TestMesh mesh;
    mesh.add({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    mesh.add({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    BvhConfig config;
    config.intersectionCost = 5.0f;
    const double expected = 5.0 * 1.0 / (8.0 + std::sqrt(3.0) / 2.0);
    EXPECT_NEAR(measureEpo(twoLeaves(bounds[0], bounds[1]), mesh.positions, mesh.triangles, config), expected, 1e-12);
}

TEST(AccelQuality, EpoOfSeparateTrianglesIsZero) {
    TestMesh mesh;
    for (int i = 0; i < 64; ++i) {
        const glm::vec3 p(static_cast<float>(2 * i), 0.0f, 0.0f);
        mesh.add(p, p + glm::vec3(1, 0, 0), p + glm::vec3(0, 1, 1));
    }
    BvhConfig config;
    config.maxLeafSize = 1;
    const Bvh bvh = buildBvh("binned", {triangleBounds(mesh.positions, mesh.triangles), {}, {}}, config);
    EXPECT_EQ(measureEpo(bvh, mesh.positions, mesh.triangles, config), 0.0);
}

TEST(AccelQuality, EpoOfATriangleInTwoLeavesByHand) {
    // As above, the first triangle in both leaves: what reaches into the other one's box is held there.
    TestMesh mesh;
    mesh.add({0, 0, 0}, {4, 0, 0}, {0, 4, 0});
    mesh.add({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    Bvh bvh = twoLeaves(bounds[0], bounds[1]);
    bvh.order = {0, 1, 0};
    bvh.nodes[2].count = 2;
    EXPECT_EQ(measureEpo(bvh, mesh.positions, mesh.triangles), 0.0);
    // Elsewhere too: the leaf reaches past the second triangle, over 4 of the 8 units of the first one's area.
    bvh.order = {0, 1};
    bvh.nodes[2] = {{glm::vec3(-1.0f), glm::vec3(2.0f)}, 0, 1, 1};
    EXPECT_NEAR(measureEpo(bvh, mesh.positions, mesh.triangles), 4.0 / (8.0 + std::sqrt(3.0) / 2.0), 1e-12);
    bvh.order = {0, 0, 1};
    bvh.nodes[2].count = 2;
    EXPECT_EQ(measureEpo(bvh, mesh.positions, mesh.triangles), 0.0);
}

/// Total cost of the nodes that hold the point but not the primitive.
double costAround(const Bvh& bvh, const BvhConfig& config, uint32_t index, const glm::vec3& point, uint32_t primitive,
                  bool& holds) {
    const BvhNode& node = bvh.nodes[index];
    double below = 0.0;
    if (node.isLeaf()) {
        const auto first = bvh.order.begin() + node.first;
        holds = std::find(first, first + node.count, primitive) != first + node.count;
    } else {
        bool left = false;
        bool right = false;
        below = costAround(bvh, config, node.left, point, primitive, left) +
                costAround(bvh, config, node.left + 1, point, primitive, right);
        holds = left || right;
    }
    const float own = node.isLeaf() ? config.intersectionCost * static_cast<float>(node.count) : config.traversalCost;
    const bool inside = node.bounds.contains({point, point});
    return below + (inside && !holds ? static_cast<double>(own) : 0.0);
}

/// By stratified points on the triangles.
double sampledEpo(const Bvh& bvh, const TestMesh& mesh, const BvhConfig& config, int points, uint32_t seed) {
    Random random(seed);
    double sum = 0.0;
    double sumArea = 0.0;
    for (uint32_t primitive = 0; primitive < mesh.triangles.size(); ++primitive) {
        const glm::uvec3& triangle = mesh.triangles[primitive];
        const glm::vec3 p0 = mesh.positions[triangle.x];
        const glm::vec3 e1 = mesh.positions[triangle.y] - p0;
        const glm::vec3 e2 = mesh.positions[triangle.z] - p0;
        const double area = 0.5 * static_cast<double>(glm::length(glm::cross(e1, e2)));
        sumArea += area;
        for (int i = 0; i < points; ++i) {
            float u = random.uniform(0.0f, 1.0f);
            float v = random.uniform(0.0f, 1.0f);
            if (u + v > 1.0f) {
                u = 1.0f - u;
                v = 1.0f - v;
            }
            bool holds = false;
            sum += area / points * costAround(bvh, config, 0, p0 + u * e1 + v * e2, primitive, holds);
        }
    }
    return sum / sumArea;
}

TEST(AccelQuality, EpoEqualsRandomSampling) {
    const TestMesh mesh = accel_test::randomSoup(200, 0.3f, 21);
    const std::vector<Aabb> bounds = triangleBounds(mesh.positions, mesh.triangles);
    BvhConfig config;
    config.traversalCost = 1.2f;
    config.spatialBudget = 1.0f;
    for (const std::string_view builder : {"binned", "spatial"}) {
        const Bvh bvh = buildBvh(builder, {bounds, mesh.positions, mesh.triangles}, config);
        EXPECT_EQ(bvh.order.size() > bounds.size(), builder == "spatial");
        const double epo = measureEpo(bvh, mesh.positions, mesh.triangles, config);
        EXPECT_GT(epo, 1.0);
        // 240,000 points; four standard errors are about 1.3 % of the result.
        EXPECT_NEAR(epo, sampledEpo(bvh, mesh, config, 1200, 22), 0.015 * epo) << builder;
    }
}

double overlapOfSiblings(const Aabb& left, const Aabb& right) {
    return measureQuality(twoLeaves(left, right)).siblingOverlap;
}

TEST(AccelQuality, SiblingOverlapByHand) {
    const Aabb unit{glm::vec3(0.0f), glm::vec3(1.0f)};
    // A box of 1 x .5 x .25 in one of 1.0 x 1.5 x 1.75: half areas .5 + .125 + .25 and 1.5 + 2.625 + 1.75.
    EXPECT_DOUBLE_EQ(overlapOfSiblings(unit, {{0.0f, 0.5f, 0.75f}, {1.0f, 1.5f, 1.75f}}), 0.875 / 5.875);
    EXPECT_DOUBLE_EQ(overlapOfSiblings(unit, unit), 1.0);
    EXPECT_EQ(overlapOfSiblings(unit, {glm::vec3(2.0f), glm::vec3(3.0f)}), 0.0);
    EXPECT_EQ(overlapOfSiblings(unit, {{1.0f, 0.0f, 0.0f}, {2.0f, 1.0f, 1.0f}}), 0.0) << "they share a face only";
    EXPECT_EQ(overlapOfSiblings({{1.0f, 0.0f, 0.0f}, {2.0f, 1.0f, 1.0f}}, unit), 0.0);
    // A flat box in the middle of the other one, and two in one plane.
    EXPECT_DOUBLE_EQ(overlapOfSiblings(unit, {{0.5f, 0.0f, 0.0f}, {0.5f, 1.0f, 1.0f}}), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(overlapOfSiblings({{0, 0, 0}, {0, 2, 1}}, {{0, 1, 0}, {0, 3, 1}}), 1.0 / 3.0);
}

TEST(AccelQuality, SiblingOverlapIsWeightedByArea) {
    // A root of 2 x 2 x 1, and its left child of 1.5 x 2 x 1 whose own children are both as large.
    const Aabb left{glm::vec3(0.0f), glm::vec3(1.5f, 2.0f, 1.0f)};
    const Aabb right{glm::vec3(0.5f, 0.0f, 0.0f), glm::vec3(2.0f, 2.0f, 1.0f)};
    Bvh bvh = twoLeaves(left, right);
    bvh.nodes[1] = {left, 3, 0, 0};
    bvh.nodes[2].first = 2;
    bvh.nodes.insert(bvh.nodes.end(), {{left, 0, 0, 1}, {left, 0, 1, 1}});
    bvh.order = {0, 1, 2};
    // Half areas: 8 and 6.5 of the inner nodes, 5 (1 x 2 x 1) and 6.5 of what is shared.
    EXPECT_DOUBLE_EQ(measureQuality(bvh).siblingOverlap, (5.0 + 6.5) / (8.0 + 6.5));
}

TEST(AccelQuality, EmptyTree) {
    const BvhQuality quality = measureQuality(Bvh());
    EXPECT_EQ(quality.sah, 0.0);
    EXPECT_EQ(quality.nodes, 0u);
    EXPECT_EQ(measureEpo(Bvh(), {}, {}), 0.0);
}

}  // namespace
}  // namespace raylab
