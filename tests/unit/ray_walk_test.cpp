#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/accel/brute_force.h"
#include "engine/accel/triangle_watertight.h"
#include "engine/accel/walk_bvh2.h"
#include "engine/measure/hit_oracle.h"
#include "engine/measure/ray_walk.h"
#include "tests/unit/inspection_support.h"

namespace raylab {
namespace {

using namespace inspection_test;

/// From a cube of twice `reach` towards points of the unit cube.
std::vector<WalkRay> randomRays(size_t count, float reach, uint32_t seed) {
    accel_test::Random random(seed);
    std::vector<WalkRay> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 from = random.inCube(-reach, reach);
        rays.push_back({from, (random.inCube(0.0f, 1.0f) - from) * random.uniform(0.2f, 3.0f)});
    }
    return rays;
}

/// All triangles in the world, instance after instance.
accel_test::TestMesh trianglesInWorld(const Scene& scene) {
    accel_test::TestMesh world;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto at = [&](uint32_t i) {
            return glm::vec3(instance.objectToWorld * glm::vec4(mesh.positions[i], 1.0f));
        };
        for (const glm::uvec3& t : mesh.triangles) world.add(at(t.x), at(t.y), at(t.z));
    }
    return world;
}

/// Index of the hit's triangle among trianglesInWorld().
uint32_t worldIndex(const Scene& scene, const PrimitiveTest& hit) {
    size_t before = 0;
    for (uint32_t i = 0; i < hit.instance; ++i) before += scene.meshes[scene.instances[i].mesh].triangles.size();
    return static_cast<uint32_t>(before + hit.primitive);
}

void expectClosestHits(const Scene& scene, const TraceConfig& config, size_t count) {
    const TreeInspection trees = inspectTrees(scene, config);
    const accel_test::TestMesh world = trianglesInWorld(scene);
    size_t hits = 0, undecidable = 0;
    for (const WalkRay& ray : randomRays(count, 2.0f, kSeed + 9)) {
        const OracleHit truth = closestHitDouble(world.positions, world.triangles, ray.origin, ray.direction, ray.tMin);
        if (truth.margin < 1e-4 || truth.tNext - truth.t < 1e-4) {
            ++undecidable;
            continue;
        }
        const RayWalk walk = walkRay(trees, ray);
        ASSERT_EQ(walk.hit.has_value(), truth.hit());
        if (!truth.hit()) continue;
        ++hits;
        EXPECT_EQ(worldIndex(scene, *walk.hit), truth.primitive);
        EXPECT_NEAR(static_cast<double>(walk.hit->t), truth.t, 1e-4 * std::max(truth.t, 1.0));
        EXPECT_EQ(walk.steps.back().tBest, walk.hit->t);
    }
    EXPECT_GT(hits, count / 10);
    EXPECT_LT(undecidable, count / 4);
}

TEST(RayWalk, FindsTheClosestHitOfBruteForceInDouble) { expectClosestHits(soupScene(1500), {}, 600); }

TEST(RayWalk, FindsItThroughInstances) {
    for (const std::string layout : {"bvh2", "bvh4b", "bvh2q"})
        expectClosestHits(instanceScene(), {.layout = layout, .trees = Trees::mesh}, 400);
}

TEST(RayWalk, FindsTheQuadricsOfTheOracle) {
    const Scene scene = support::quadricScene(kSeed);
    const TreeInspection trees = inspectTrees(scene, {});
    const HitOracle oracle(scene);
    const Aabb box = worldBox(trees, trees.root());
    accel_test::Random random(kSeed + 4);
    size_t hits = 0, others = 0;
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 from = box.lo + random.inCube(0.0f, 1.0f) * box.extent();
        const WalkRay ray{from, random.direction()};
        const TrueHit truth = oracle.closest({ray.origin, ray.tMin, ray.direction, ray.tMax});
        const RayWalk walk = walkRay(trees, ray);
        const bool same =
            walk.hit.has_value() == truth.hit() &&
            (!truth.hit() || std::abs(static_cast<double>(walk.hit->t) - truth.t) < 1e-3 * std::max(1.0, truth.t));
        hits += truth.hit() ? 1 : 0;
        others += same ? 0 : 1;  // grazing rays alone may differ
    }
    EXPECT_GT(hits, 40u);
    EXPECT_LE(others, 2u);
}

/// The leaves that the layout's own walk over 64-byte nodes comes to, as it comes to them.
TEST(RayWalk, VisitsTheLeavesOfTheKernelsWalkInItsOrder) {
    const TreeInspection trees = inspectTrees(soupScene(1500), {.layout = "bvh2"});
    const FlatTree flat = flatten("bvh2", trees.bvh(0), 0, 0);
    for (const WalkRay& ray : randomRays(200, 1.5f, kSeed + 10)) {
        const RayWalk walk = walkRay(trees, ray);
        std::vector<uint32_t> expected, visited;
        float tMax = ray.tMax;
        const WatertightRay watertight = makeWatertightRay(ray.origin, ray.direction);
        const uint32_t deepest =
            walkBvh2(flat, 0, ray.origin, ray.direction, ray.tMin, tMax, [&](uint32_t first, uint32_t count) {
                expected.push_back(first);
                for (uint32_t slot = first; slot < first + count; ++slot) {
                    const shared::TraceTriangle& p = trees.data.triangles[slot];
                    float t = 0.0f, u = 0.0f, v = 0.0f;
                    if (intersectWatertight(watertight, p.p0, p.p1, p.p2, ray.tMin, tMax, t, u, v)) tMax = t;
                }
            });
        size_t highest = 0;
        for (const WalkStep& step : walk.steps) {
            highest = std::max(highest, step.stack.size());
            if (step.kind == WalkKind::leaf) visited.push_back(trees.node(step.at).first);
        }
        EXPECT_EQ(visited, expected);
        EXPECT_EQ(highest, deepest);
    }
}

TEST(RayWalk, GoesToTheNearerChildAndPopsTheOther) {
    const TreeInspection trees = inspectTrees(instanceScene(), kMeshTrees);
    size_t pops = 0;
    for (const WalkRay& ray : randomRays(60, 2.0f, kSeed + 11)) {
        const RayWalk walk = walkRay(trees, ray);
        ASSERT_EQ(walk.steps.front().at, trees.root());
        EXPECT_TRUE(walk.steps.back().stack.empty());
        std::vector<TreeNode> before;
        for (size_t i = 0; i + 1 < walk.steps.size(); ++i) {
            const WalkStep& step = walk.steps[i];
            const TreeNode next = walk.steps[i + 1].at;
            const bool pushes = step.kind == WalkKind::inner && step.boxes[0].hit && step.boxes[1].hit;
            const bool goesOn = step.kind == WalkKind::instance ||
                                (step.kind == WalkKind::inner && (step.boxes[0].hit || step.boxes[1].hit));
            if (pushes) {
                const bool left = next == step.boxes[0].at;
                EXPECT_LE(step.boxes[left ? 0 : 1].tNear, step.boxes[left ? 1 : 0].tNear);
                EXPECT_EQ(step.stack.back(), step.boxes[left ? 1 : 0].at);
                EXPECT_EQ(step.stack.size(), before.size() + 1);
            } else if (!goesOn) {
                EXPECT_EQ(next, before.back());
                EXPECT_EQ(step.stack.size() + 1, before.size());
                ++pops;
            }
            before = step.stack;
        }
    }
    EXPECT_GT(pops, 100u);
}

TEST(RayWalk, BouncesByTheLawsOfMirrorAndCosine) {
    Scene scene;
    const uint32_t material = support::addMaterial(scene, support::lambert(0.5f));
    support::addMesh(scene, support::floorQuad(material, 4.0f));
    const TreeInspection trees = inspectTrees(scene, {});
    const RayWalk walk = walkRay(trees, {{0.1f, 2.0f, 0.2f}, {0.3f, -1.0f, 0.1f}});
    ASSERT_TRUE(walk.hit.has_value());
    EXPECT_NEAR(walk.normal.y, 1.0f, 1e-6f);
    const glm::vec3 mirrored = mirrorBounce(walk)->direction, expected = glm::normalize(glm::vec3(0.3f, 1.0f, 0.1f));
    EXPECT_LT(glm::distance(mirrored, expected), 1e-6f);
    double sum = 0.0;
    constexpr int kSide = 64;
    for (int i = 0; i < kSide * kSide; ++i) {
        const float u0 = (static_cast<float>(i / kSide) + 0.5f) / kSide,
                    u1 = (static_cast<float>(i % kSide) + 0.5f) / kSide;
        const WalkRay ray = *diffuseBounce(walk, u0, u1);
        EXPECT_NEAR(glm::length(ray.direction), 1.0f, 1e-5f);
        sum += static_cast<double>(ray.direction.y);
        EXPECT_GT(ray.origin.y, 0.0f);
    }
    EXPECT_NEAR(sum / (kSide * kSide), 2.0 / 3.0, 1e-3);  // mean cosine of the density cos / pi
    EXPECT_FALSE(mirrorBounce(walkRay(trees, {{0.0f, 2.0f, 0.0f}, {0.0f, 1.0f, 0.0f}})).has_value());
}

}  // namespace
}  // namespace raylab
