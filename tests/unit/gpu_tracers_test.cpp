#include <cmath>

#include "engine/accel/builders.h"
#include "engine/measure/hit_oracle.h"
#include "engine/render/prepared_scene.h"
#include "engine/scene/quadric.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"
#include "tests/unit/cut_out.h"

/// Every tracer that the device runs, by merged trees and by a tree a mesh, against double precision.
namespace raylab::support {
namespace {

constexpr size_t kRays = 8000;

/// Verdicts on what a tracer says.
struct Score {
    size_t hits = 0;
    size_t wrong = 0;
    size_t wrongShadows = 0;
    size_t undecidable = 0;
};

Score scoreOf(RayCaster& caster, const HitOracle& oracle, const std::vector<shared::RayData>& rays) {
    const std::vector<shared::HitData> closest = caster.closest(rays), occluded = caster.occluded(rays);
    Score score;
    const auto isWrong = [](Verdict verdict) { return verdict == Verdict::bRight || verdict == Verdict::neither; };
    for (uint32_t i = 0; i < rays.size(); ++i) {
        const TrueHit truth = oracle.closest(rays[i], i);
        // The truth as the other side of the comparison.
        shared::HitData exact{.t = truth.hit() ? static_cast<float>(truth.t) : -1.0f};
        if (truth.hit()) {
            exact.instance = truth.instance;
            exact.primitive = truth.primitive;
        }
        const Verdict verdict = oracle.judgeClosest(rays[i], i, closest[i], exact).verdict;
        score.wrong += isWrong(verdict) ? 1u : 0u;
        score.undecidable += verdict == Verdict::undecidable ? 1u : 0u;
        score.wrongShadows += isWrong(oracle.judgeOccluded(rays[i], i, occluded[i], exact).verdict) ? 1u : 0u;
        score.hits += closest[i].t >= 0.0f ? 1u : 0u;
    }
    return score;
}

class EveryTracer : public GpuTest {
protected:
    /// `most`: undecidable rays.
    void expectRight(const Scene& scene, uint32_t seed, size_t most) {
        const HitOracle oracle(scene);
        const std::vector<shared::RayData> rays = randomRays(scene, kRays, seed);
        for (const RenderSettings& settings : everyTracer(device_.description())) {
            RayCaster caster(device_, scene, settings);
            ASSERT_EQ(caster.prepared().tracer->info().name, settings.tracer);
            const Score score = scoreOf(caster, oracle, rays);
            EXPECT_EQ(score.wrong, 0u) << nameOf(settings);
            EXPECT_EQ(score.wrongShadows, 0u) << nameOf(settings);
            EXPECT_LE(score.undecidable, most) << nameOf(settings);
            EXPECT_GT(score.hits, kRays / 20) << nameOf(settings);
        }
    }
};

TEST_F(EveryTracer, HitsTriangles) { expectRight(soupScene(3000, 0.08f), 301, kRays / 100); }

TEST_F(EveryTracer, HitsInstances) { expectRight(instancedSoup(), 302, kRays / 100); }

TEST_F(EveryTracer, HitsQuadrics) { expectRight(quadricScene(1), 303, kRays / 50); }

TEST_F(EveryTracer, SkipsCutOuts) {
    Scene scene = instancedSoup();
    cutOut(scene);
    expectRight(scene, 304, kRays / 50);
}

TEST_F(EveryTracer, BlendsByTheSameHash) {
    Scene scene = soupScene(1000, 0.2f);
    for (Material& material : scene.materials) {
        material.alpha = 0.4f;
        material.alphaMode = AlphaMode::blend;
    }
    expectRight(scene, 305, kRays / 50);
}

/// The hole that a texture leaves of a sphere: the columns with u below a half.
TEST_F(EveryTracer, CutsQuadricsByTheirTexture) {
    Scene scene;
    const uint32_t material = addMaterial(scene, lambert(0.5f));
    Texture texture;
    texture.width = 2;
    texture.height = 1;
    texture.texels = {0x00ffffffu, 0xffffffffu};
    scene.textures = {texture};
    scene.materials[0].baseColorTexture = 0;
    scene.materials[0].alphaMode = AlphaMode::mask;
    Mesh mesh;
    mesh.material = material;
    mesh.quadrics = {Quadric{}};
    addMesh(scene, mesh);
    // Along -Y the near half has y > 0, which is u < 1/2: a hole, behind which lies the far half.
    const std::vector<shared::RayData> rays = {makeRay({0.1f, 3.0f, 0.2f}, {0, -1, 0}), makeRay({0.1f, -3.0f, 0.2f}, {0, 1, 0})};
    const float depth = std::sqrt(1.0f - 0.01f - 0.04f);
    for (const RenderSettings& settings : everyTracer(device_.description())) {
        RayCaster caster(device_, scene, settings);
        const std::vector<shared::HitData> hits = caster.closest(rays);
        EXPECT_NEAR(hits[0].t, 3.0f + depth, 1e-5f) << nameOf(settings);
        EXPECT_NEAR(hits[1].t, 3.0f - depth, 1e-5f) << nameOf(settings);
        EXPECT_NEAR(hits[1].u, 1.0 - std::atan2(depth, 0.1) / (2.0 * kPi), 1e-5) << nameOf(settings);
        EXPECT_NEAR(hits[1].v, std::acos(0.2) / kPi, 1e-5) << nameOf(settings);
    }
}

TEST_F(EveryTracer, MissesAnEmptyScene) {
    Scene scene = soupScene(10, 0.3f);
    const std::vector<shared::RayData> rays = randomRays(scene, 100, 306);
    scene.instances.clear();
    for (const RenderSettings& settings : everyTracer(device_.description())) {
        RayCaster caster(device_, scene, settings);
        for (const shared::HitData& hit : caster.closest(rays)) EXPECT_LT(hit.t, 0.0f) << nameOf(settings);
        for (const shared::HitData& hit : caster.occluded(rays)) EXPECT_LT(hit.t, 0.0f) << nameOf(settings);
    }
}

/// Quadrics in the leaves of every layout, and below every builder.
TEST_F(EveryTracer, QuadricsInEveryLayoutAndBuilder) {
    const Scene scene = quadricScene(2);
    const HitOracle oracle(scene);
    const std::vector<shared::RayData> rays = randomRays(scene, 2000, 307);
    std::vector<RenderSettings> choices = everyLayoutAndTest();
    for (const std::string& builder : builderNames()) {
        choices.emplace_back();
        choices.back().builder = builder;
    }
    for (const RenderSettings& settings : choices) {
        RayCaster caster(device_, scene, settings);
        const Score score = scoreOf(caster, oracle, rays);
        EXPECT_EQ(score.wrong, 0u) << nameOf(settings);
        EXPECT_EQ(score.wrongShadows, 0u) << nameOf(settings);
        EXPECT_GT(score.hits, rays.size() / 20) << nameOf(settings);
    }
}

/// A device that lacks an extension says which, and does without the tracers that need it.
TEST_F(EveryTracer, NamesTheMissingExtension) {
    DeviceDescription device;
    device.rayTracing = {"VK_KHR_ray_query", ""};
    EXPECT_EQ(missingForTracer("query", device), "VK_KHR_ray_query");
    EXPECT_EQ(missingForTracer("pipeline", device), "");
    EXPECT_EQ(missingForTracer("software", device), "");
}

}  // namespace
}  // namespace raylab::support
