#include "engine/measure/hit_oracle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/accel/brute_force.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

namespace raylab::support {
namespace {

constexpr uint32_t kSeed = 4711;

shared::HitData hitAt(double t, uint32_t instance = 0, uint32_t primitive = 0) {
    shared::HitData hit{};
    hit.t = static_cast<float>(t);
    hit.instance = instance;
    hit.primitive = primitive;
    return hit;
}

shared::HitData claimOf(const TrueHit& truth) {
    return truth.hit() ? hitAt(truth.t, truth.instance, truth.primitive) : hitAt(-1.0);
}

const shared::HitData kMiss = hitAt(-1.0);

Scene quadricScene(const Quadric& quadric, const glm::mat4& matrix = glm::mat4(1.0f)) {
    Scene scene;
    Mesh mesh;
    mesh.material = addMaterial(scene, lambert(0.5f));
    mesh.quadrics = {quadric};
    addMesh(scene, mesh, matrix);
    return scene;
}

/// Two triangles of the plane z = 0, [0, 1] x [0, 1], that share the diagonal.
Scene squareScene(float z = 0.0f) {
    Scene scene;
    addMesh(scene, quad(addMaterial(scene, lambert(0.5f)), {0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}));
    return scene;
}

shared::RayData downAt(float x, float y) { return makeRay({x, y, 2.0f}, {0, 0, -1}); }

TEST(HitOracle, AgreesWithBruteForceOnASoup) {
    const Scene scene = soupScene(1000, 0.2f);
    const HitOracle oracle(scene);
    const std::vector<shared::RayData> rays = randomRays(scene, 1000, kSeed);
    const std::vector<OracleHit> expected = oracleHits(flatten(scene), rays);
    size_t hits = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (expected[i].margin < 1e-9) continue;
        const TrueHit truth = oracle.closest(rays[i]);
        ASSERT_EQ(truth.hit(), expected[i].hit()) << i;
        if (!truth.hit()) continue;
        ++hits;
        EXPECT_EQ(truth.primitive, expected[i].primitive) << i;
        EXPECT_NEAR(truth.t, expected[i].t, 1e-10 * expected[i].t) << i;
    }
    EXPECT_GT(hits, 300u);
}

TEST(HitOracle, AgreesWithBruteForceOnMovedMirroredAndShearedInstances) {
    const Scene scene = instancedSoup();
    const HitOracle oracle(scene);
    const Flattened flat = flatten(scene);  // its positions are rounded to float
    const std::vector<shared::RayData> rays = randomRays(scene, 500, kSeed);
    const std::vector<OracleHit> expected = oracleHits(flat, rays);
    size_t hits = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (!isDecidable(expected[i], 1e-4)) continue;
        const TrueHit truth = oracle.closest(rays[i]);
        ASSERT_EQ(truth.hit(), expected[i].hit()) << i;
        if (!truth.hit()) continue;
        ++hits;
        EXPECT_EQ(glm::uvec2(truth.instance, truth.primitive), flat.ids[expected[i].primitive]) << i;
        EXPECT_NEAR(truth.t, expected[i].t, 1e-3 * expected[i].t) << i;
    }
    EXPECT_GT(hits, 100u);
}

struct QuadricCase {
    const char* name;
    Quadric quadric;
    glm::vec3 origin;
    glm::vec3 direction;
    double t;  ///< negative: no hit
};

/// By hand from the equations in engine/scene/scene.h.
const std::array kQuadrics = {
    QuadricCase{"near side of a sphere",
                {QuadricKind::ellipsoid, {2, 2, 2}, -2, 2},
                {0.3f, 0.4f, 9},
                {0, 0, -3},
                (9.0 - 1.9364916731037085) / 3.0},
    QuadricCase{
        "far side where the near one is cut", {QuadricKind::ellipsoid, {2, 2, 2}, -2, 1}, {0, 0, 9}, {0, 0, -1}, 11.0},
    QuadricCase{"past a sphere", {QuadricKind::ellipsoid, {2, 2, 2}, -2, 2}, {2.5f, 0, 9}, {0, 0, -1}, -1.0},
    QuadricCase{
        "ellipsoid along its middle axis", {QuadricKind::ellipsoid, {1, 3, 2}, -2, 2}, {0, 5, 0}, {0, -1, 0}, 2.0},
    QuadricCase{"cylinder from the side", {QuadricKind::cylinder, {1, 2, 1}, -1, 1}, {5, 0, 0.5f}, {-1, 0, 0}, 4.0},
    QuadricCase{"above a cylinder", {QuadricKind::cylinder, {1, 2, 1}, -1, 1}, {5, 0, 1.5f}, {-1, 0, 0}, -1.0},
    QuadricCase{"into an open cylinder", {QuadricKind::cylinder, {1, 1, 1}, -1, 1}, {0, 0, 3}, {0.25f, 0, -1}, 4.0},
    QuadricCase{"along a cylinder", {QuadricKind::cylinder, {1, 1, 1}, -1, 1}, {0.5f, 0, 3}, {0, 0, -1}, -1.0},
    QuadricCase{"cone at height 1", {QuadricKind::cone, {1, 1, 2}, 0, 2}, {3, 0, 1}, {-1, 0, 0}, 2.5},
    QuadricCase{"lower nappe cut away", {QuadricKind::cone, {1, 1, 2}, 0, 2}, {3, 0, -1}, {-1, 0, 0}, -1.0},
    QuadricCase{"waist of a hyperboloid", {QuadricKind::hyperboloid, {1, 1, 1}, -1, 1}, {4, 0, 0}, {-1, 0, 0}, 3.0},
    QuadricCase{"hyperboloid above", {QuadricKind::hyperboloid, {1, 1, 1}, -1, 1}, {4, 0, 0.75f}, {-1, 0, 0}, 2.75},
    QuadricCase{
        "paraboloid along its axis", {QuadricKind::paraboloid, {1, 1, 1}, 0, 4}, {1.5f, 0, 9}, {0, 0, -1}, 6.75},
    QuadricCase{"paraboloid from the side", {QuadricKind::paraboloid, {1, 1, 1}, 0, 4}, {9, 0, 2.25f}, {-1, 0, 0}, 7.5},
};

TEST(HitOracle, MeetsQuadricsWhereTheirEquationsSay) {
    for (const QuadricCase& c : kQuadrics) {
        const Scene scene = quadricScene(c.quadric);
        const HitOracle oracle(scene);
        const shared::RayData ray = makeRay(c.origin, c.direction);
        const TrueHit truth = oracle.closest(ray);
        ASSERT_EQ(truth.hit(), c.t > 0.0) << c.name;
        if (truth.hit()) {
            EXPECT_NEAR(truth.t, c.t, 1e-6) << c.name;  // 0.3 and 0.4 are floats
        }
        const Judgement judgement = oracle.judgeClosest(ray, 0, hitAt(1.01 * c.t), claimOf(truth));
        EXPECT_EQ(judgement.verdict, truth.hit() ? Verdict::bRight : Verdict::tie) << c.name;
    }
}

TEST(HitOracle, MovesQuadricsWithTheirInstances) {
    // Mirrored and stretched: half axes 2, 1 and 3 around (5, 0, 0). Sheared: x' = x + y.
    glm::mat4 matrix = glm::translate(glm::mat4(1.0f), {5, 0, 0}) * glm::scale(glm::mat4(1.0f), {-2, 1, 3});
    const Scene scene = quadricScene({}, matrix);
    EXPECT_NEAR(HitOracle(scene).closest(makeRay({9, 0, 0}, {-1, 0, 0})).t, 2.0, 1e-12);
    EXPECT_NEAR(HitOracle(scene).closest(makeRay({5, 0, 9}, {0, 0, -1})).t, 6.0, 1e-12);
    matrix = glm::mat4(1.0f);
    matrix[1] = {1, 1, 0, 0};
    const Scene sheared = quadricScene({}, matrix);
    // (x - y)^2 + y^2 = 1 at y = 0.6: x = 0.6 + 0.8.
    EXPECT_NEAR(HitOracle(sheared).closest(makeRay({5, 0.6f, 0}, {-1, 0, 0})).t, 3.6, 1e-6);
}

TEST(HitOracle, GrazingASphereIsUndecidableAndNextToItIsNot) {
    const Scene scene = quadricScene({});
    const HitOracle oracle(scene);
    const auto verdictAt = [&](float x) {
        const shared::RayData ray = makeRay({x, 0, 4}, {0, 0, -1});
        return oracle.judgeClosest(ray, 0, hitAt(4.0), kMiss).verdict;
    };
    EXPECT_EQ(verdictAt(1.0f), Verdict::undecidable);
    EXPECT_EQ(verdictAt(1.0f + 0x1p-23f), Verdict::undecidable);
    EXPECT_EQ(verdictAt(1.0001f), Verdict::bRight);
    EXPECT_EQ(
        oracle
            .judgeClosest(makeRay({0.9999f, 0, 4}, {0, 0, -1}), 0, hitAt(4.0 - std::sqrt(1.0 - 0.9999 * 0.9999)), kMiss)
            .verdict,
        Verdict::aRight);
}

TEST(HitOracle, TellsRightFromWrong) {
    const Scene scene = squareScene();
    const HitOracle oracle(scene);
    const shared::RayData inside = downAt(0.7f, 0.2f), outside = downAt(1.5f, 0.5f);
    const shared::HitData right = hitAt(2.0);
    EXPECT_EQ(oracle.judgeClosest(inside, 0, right, kMiss).verdict, Verdict::aRight);
    EXPECT_EQ(oracle.judgeClosest(inside, 0, kMiss, right).verdict, Verdict::bRight);
    EXPECT_EQ(oracle.judgeClosest(inside, 0, hitAt(2.0, 0, 1), right).verdict, Verdict::bRight) << "primitive";
    EXPECT_EQ(oracle.judgeClosest(inside, 0, hitAt(2.0, 1, 0), right).verdict, Verdict::bRight) << "instance";
    EXPECT_EQ(oracle.judgeClosest(inside, 0, hitAt(2.0001), right).verdict, Verdict::bRight) << "distance";
    EXPECT_EQ(oracle.judgeClosest(inside, 0, hitAt(std::nanf("")), right).verdict, Verdict::bRight);
    EXPECT_EQ(oracle.judgeClosest(inside, 0, hitAt(1.0), kMiss).verdict, Verdict::neither);
    EXPECT_EQ(oracle.judgeClosest(outside, 0, right, kMiss).verdict, Verdict::bRight);
    EXPECT_EQ(oracle.judgeOccluded(inside, 0, hitAt(1.0), kMiss).verdict, Verdict::aRight);
    EXPECT_EQ(oracle.judgeOccluded(outside, 0, hitAt(1.0), kMiss).verdict, Verdict::bRight);
}

TEST(HitOracle, KnowsTheEndsOfARay) {
    const Scene scene = squareScene();
    const HitOracle oracle(scene);
    const auto verdict = [&](float tMin, float tMax) {
        return oracle.judgeClosest(makeRay({0.7f, 0.2f, 2}, {0, 0, -1}, tMin, tMax), 0, hitAt(2.0), kMiss).verdict;
    };
    EXPECT_EQ(verdict(0.0f, 3.0f), Verdict::aRight);
    EXPECT_EQ(verdict(0.0f, 1.9f), Verdict::bRight);
    EXPECT_EQ(verdict(2.1f, 3.0f), Verdict::bRight);
    EXPECT_EQ(verdict(0.0f, 2.0f), Verdict::undecidable);
    EXPECT_EQ(verdict(2.0f, 3.0f), Verdict::undecidable);
}

TEST(HitOracle, SharedEdgesAreTiesAndDoNotLeak) {
    const Scene scene = squareScene();
    const HitOracle oracle(scene);
    const shared::RayData diagonal = downAt(0.3f, 0.3f);
    EXPECT_EQ(oracle.judgeClosest(diagonal, 0, hitAt(2.0, 0, 0), hitAt(2.0, 0, 1)).verdict, Verdict::tie);
    EXPECT_EQ(oracle.judgeClosest(diagonal, 0, hitAt(2.0, 0, 0), kMiss).verdict, Verdict::aRight);
    EXPECT_EQ(oracle.judgeOccluded(diagonal, 0, kMiss, hitAt(1.0)).verdict, Verdict::bRight);
    // The border of the square is shared with nobody.
    EXPECT_EQ(oracle.judgeClosest(downAt(1.0f, 0.4f), 0, hitAt(2.0), kMiss).verdict, Verdict::undecidable);
    EXPECT_EQ(oracle.judgeClosest(downAt(1.0f, 1.0f), 0, hitAt(2.0), kMiss).verdict, Verdict::undecidable);
}

TEST(HitOracle, SurfacesThatOnlyAbutMayLeak) {
    // The left one's edge is the right one's edges and a corner between: a T-junction.
    Scene scene;
    Mesh mesh;
    mesh.material = addMaterial(scene, lambert(0.5f));
    mesh.positions = {{-1, 0.5f, 0}, {0, 0, 0}, {0, 1, 0}, {1, 0.5f, 0}, {0, 0.5f, 0}};
    mesh.triangles = {{0, 1, 2}, {1, 3, 4}, {4, 3, 2}};
    addMesh(scene, mesh);
    const HitOracle oracle(scene);
    EXPECT_EQ(oracle.judgeClosest(downAt(0, 0.25f), 0, hitAt(2.0), kMiss).verdict, Verdict::undecidable);
    EXPECT_EQ(oracle.judgeClosest(downAt(0.5f, 0.5f), 0, hitAt(2.0, 0, 1), kMiss).verdict, Verdict::aRight);
}

TEST(HitOracle, EveryMissAtTheEdgesOfAClosedMeshIsWrong) {
    for (const glm::vec3 centre : {glm::vec3(0.0f), glm::vec3(1000.0f, -500.0f, 20.0f)}) {
        const accel_test::TestMesh mesh = ball(30, centre);
        const Scene scene = sceneOf(mesh);
        const HitOracle oracle(scene);
        size_t wrong = 0;
        const std::vector<shared::RayData> rays = raysAtEdges(mesh, centre, 4000);
        for (const shared::RayData& ray : rays) {
            const TrueHit truth = oracle.closest(ray);
            ASSERT_TRUE(truth.hit());
            const Verdict verdict = oracle.judgeClosest(ray, 0, claimOf(truth), kMiss).verdict;
            EXPECT_NE(verdict, Verdict::bRight);
            wrong += verdict == Verdict::aRight ? 1 : 0;
        }
        EXPECT_EQ(wrong, rays.size());
    }
}

TEST(HitOracle, SilhouettesAreUndecidable) {
    Scene scene;
    addMesh(scene, box(addMaterial(scene, lambert(0.5f)), glm::vec3(-1.0f), glm::vec3(1.0f)));
    const HitOracle oracle(scene);
    accel_test::Random random(kSeed);
    for (int i = 0; i < 200; ++i) {
        // From beyond the +x +y edge, at right angles to its diagonal, at a point of it.
        const float z = random.uniform(-0.9f, 0.9f);
        const shared::RayData ray = makeRay({3.0f, -1.0f, z}, {-1.0f, 1.0f, 0.0f});
        const TrueHit corner{2.0, 0, 0};
        const Verdict asMiss = oracle.judgeOccluded(ray, 0, kMiss, claimOf(corner)).verdict;
        EXPECT_EQ(asMiss, Verdict::undecidable);
        const shared::RayData past = makeRay({3.0f, -0.999f, z}, {-1.0f, 1.0f, 0.0f});
        EXPECT_EQ(oracle.judgeOccluded(past, 0, kMiss, hitAt(1.0)).verdict, Verdict::aRight);
    }
}

TEST(HitOracle, CoplanarSurfacesTieAndHiddenOnesAreWrong) {
    Scene scene = squareScene();
    addInstance(scene, 0, glm::mat4(1.0f));
    addMesh(scene, squareScene(-0.5f).meshes[0]);
    const HitOracle oracle(scene);
    const shared::RayData ray = downAt(0.7f, 0.2f);
    EXPECT_EQ(oracle.judgeClosest(ray, 0, hitAt(2.0, 0, 0), hitAt(2.0, 1, 0)).verdict, Verdict::tie);
    EXPECT_EQ(oracle.judgeClosest(ray, 0, hitAt(2.0, 1, 0), hitAt(2.5, 2, 0)).verdict, Verdict::aRight);
}

TEST(HitOracle, TheMarginGrowsWithTheCoordinates) {
    // The same ray past the same square by 1e-4, near the eye and seen from 1e5 away.
    const Scene scene = squareScene();
    const HitOracle oracle(scene);
    const auto verdictFrom = [&](float z) {
        return oracle.judgeOccluded(makeRay({1.0001f, 0.5f, z}, {0, 0, -1}), 0, hitAt(1.0), kMiss).verdict;
    };
    EXPECT_EQ(verdictFrom(2.0f), Verdict::bRight);
    EXPECT_EQ(verdictFrom(1e5f), Verdict::undecidable);
    // A moved instance is as far away as what its transform adds up.
    Scene far;
    addMesh(far, scene.meshes[0], glm::translate(glm::mat4(1.0f), {1e5f, 0, 0}));
    addMaterial(far, lambert(0.5f));
    EXPECT_EQ(
        HitOracle(far).judgeOccluded(makeRay({1e5f - 0x1p-7f, 0.5f, 2}, {0, 0, -1}), 0, hitAt(1.0), kMiss).verdict,
        Verdict::undecidable);
}

/// A square whose texture is opaque to the left of u = 0.5 and clear to the right.
Scene cutOutScene(AlphaMode mode) {
    Scene scene = squareScene();
    Texture texture;
    texture.width = texture.height = 4;
    texture.wrapU = texture.wrapV = Wrap::clamp;
    for (uint32_t i = 0; i < 16; ++i) texture.texels.push_back((i & 3u) < 2 ? 0xffffffffu : 0x00ffffffu);
    scene.textures = {texture};
    scene.materials[0].baseColorTexture = 0;
    scene.materials[0].alphaMode = mode;
    return scene;
}

TEST(HitOracle, MasksByBilinearAlpha) {
    const Scene scene = cutOutScene(AlphaMode::mask);
    const HitOracle oracle(scene);
    EXPECT_TRUE(oracle.closest(downAt(0.45f, 0.6f)).hit());
    EXPECT_FALSE(oracle.closest(downAt(0.55f, 0.6f)).hit());
    // Between the columns' centres at 0.375 and 0.625 alpha falls from 1 to 0; the cutoff is at 0.5.
    const auto verdictAt = [&](float x) {
        return oracle.judgeClosest(downAt(x, 0.6f), 0, hitAt(2.0, 0, x < 0.6f ? 1 : 0), kMiss).verdict;
    };
    EXPECT_EQ(verdictAt(0.499f), Verdict::aRight);
    EXPECT_EQ(verdictAt(0.5f), Verdict::undecidable);
    EXPECT_EQ(verdictAt(0.501f), Verdict::bRight);
}

TEST(HitOracle, LooksUpTheAlphaOfANeighbourWhereTheRayPassesIt) {
    const Scene scene = cutOutScene(AlphaMode::mask);
    const HitOracle oracle(scene);
    // A float beside the diagonal, over the second triangle; both share the corner at the origin, which is opaque.
    const auto verdictOnNeighbour = [&](float x) {
        const shared::RayData ray = downAt(x, std::nextafter(x, 1.0f));
        return oracle.judgeClosest(ray, 0, hitAt(2.0, 0, 0), kMiss).verdict;
    };
    EXPECT_EQ(verdictOnNeighbour(0.3f), Verdict::aRight);
    EXPECT_EQ(verdictOnNeighbour(0.7f), Verdict::bRight);
}

TEST(HitOracle, BlendsAsOftenAsAlphaSays) {
    Scene scene = squareScene();
    scene.materials[0].alphaMode = AlphaMode::blend;
    scene.materials[0].alpha = 0.3f;
    const HitOracle oracle(scene);
    constexpr uint32_t kKeys = 20000;
    size_t hits = 0;
    for (uint32_t key = 0; key < kKeys; ++key) hits += oracle.closest(downAt(0.7f, 0.2f), key).hit() ? 1 : 0;
    // Four standard deviations of 0.3.
    EXPECT_NEAR(static_cast<double>(hits) / kKeys, 0.3, 4.0 * std::sqrt(0.21 / kKeys));
}

using HitOracleOnDevice = GpuTest;

/// From above at points on and around the unit square.
std::vector<shared::RayData> raysAtSquare(size_t count) {
    accel_test::Random random(kSeed);
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 origin(random.uniform(-1.0f, 2.0f), random.uniform(-1.0f, 2.0f), random.uniform(0.1f, 3.0f));
        const glm::vec3 target(random.uniform(-0.1f, 1.1f), random.uniform(-0.1f, 1.1f), 0.0f);
        rays.push_back(makeRay(origin, target - origin));
    }
    return rays;
}

/// What the kernels answer must be right by the oracle: blended and cut out surfaces, instances, rays along axes.
TEST_F(HitOracleOnDevice, SoftwareIsNeverWrong) {
    Scene blended = instancedSoup();
    blended.materials[0].alphaMode = AlphaMode::blend;
    blended.materials[0].alpha = 0.5f;
    const std::array<Scene, 5> scenes = {instancedSoup(), blended, cutOutScene(AlphaMode::mask),
                                         cutOutScene(AlphaMode::blend), gridOfCubes()};
    for (size_t s = 0; s < scenes.size(); ++s) {
        const HitOracle oracle(scenes[s]);
        RayCaster caster(device_, scenes[s], {});
        std::vector<shared::RayData> rays = randomRays(scenes[s], 20000, kSeed);
        if (s == 2 || s == 3) rays = raysAtSquare(20000);
        if (s == 4) rays = raysAlongAxes(20000, kSeed);
        const std::vector<shared::HitData> closest = caster.closest(rays), occluded = caster.occluded(rays);
        size_t wrong = 0, sure = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            const auto key = static_cast<uint32_t>(i);
            wrong += oracle.judgeClosest(rays[i], key, closest[i], closest[i]).verdict == Verdict::neither ? 1 : 0;
            wrong += oracle.judgeOccluded(rays[i], key, occluded[i], occluded[i]).verdict == Verdict::neither ? 1 : 0;
            const shared::HitData opposite = closest[i].t < 0.0f ? hitAt(1.0) : kMiss;
            sure += oracle.judgeOccluded(rays[i], key, closest[i], opposite).verdict == Verdict::aRight ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0u) << "scene " << s;
        EXPECT_GT(sure, rays.size() / (s == 4 ? 4 : 2)) << "scene " << s << ": the oracle decides too little";
    }
}

}  // namespace
}  // namespace raylab::support
