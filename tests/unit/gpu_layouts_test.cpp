#include "tests/support/gpu_test.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"
#include "tests/unit/cut_out.h"

/// Every layout and every triangle test on the device, against the oracle and against the tracer without a tree.
namespace raylab::support {
namespace {

using Layouts = GpuTest;

TEST_F(Layouts, OneTreeAndTwoLevelsAgreeWithOracle) {
    const Scene scene = instancedSoup();
    const OracleCase oracle(scene, randomRays(scene, 4000, 84), 1e-3);
    for (const RenderSettings& layout : everyLayout())
        for (const RenderSettings& settings : {layout, twoLevels(layout)}) {
            SCOPED_TRACE(nameOf(settings));
            RayCaster caster(device_, scene, settings);
            EXPECT_EQ((caster.prepared().needs.mask & shared::kNeedInstancing) != 0u, settings.flattenLimit == 0);
            expectAgreement(compareWithOracle(caster, oracle), oracle.rays.size());
        }
}

TEST_F(Layouts, EveryTriangleTestAgreesWithOracle) {
    const Scene scene = soupScene(5000, 0.06f);
    const OracleCase oracle(scene, randomRays(scene, 20000, 95), 1e-4);
    for (const RenderSettings& settings : everyLayoutAndTest()) {
        SCOPED_TRACE(nameOf(settings));
        RayCaster caster(device_, scene, settings);
        expectAgreement(compareWithOracle(caster, oracle), oracle.rays.size());
    }
}

/// A leaf may end anywhere in a fetch or a group of lanes.
TEST_F(Layouts, EveryLeafSizeAgreesWithOracle) {
    const Scene scene = soupScene(500, 0.1f);
    const OracleCase oracle(scene, randomRays(scene, 4000, 96), 1e-4);
    for (RenderSettings settings : everyLayout())
        for (const int64_t leafSize : {1, 3, 16}) {
            settings.leafSize = leafSize;
            SCOPED_TRACE(nameOf(settings));
            RayCaster caster(device_, scene, settings);
            expectAgreement(compareWithOracle(caster, oracle), oracle.rays.size());
        }
}

TEST_F(Layouts, CutOutTrianglesAreThoseOfBruteForce) {
    Scene scene = instancedSoup();
    cutOut(scene);
    const std::vector<shared::RayData> rays = randomRays(scene, 4000, 97);
    RenderSettings one, two = twoLevels(one);
    for (const RenderSettings& levels : {one, two}) {
        RayCaster brute(device_, scene, bruteForce(levels));
        const std::vector<shared::HitData> closest = brute.closest(rays), occluded = brute.occluded(rays);
        for (RenderSettings settings : everyLayout()) {
            settings.flattenLimit = levels.flattenLimit;
            RayCaster caster(device_, scene, settings);
            EXPECT_EQ(countDifferentHits(caster.closest(rays), closest), 0u) << nameOf(settings);
            EXPECT_EQ(countDifferentHits(caster.occluded(rays), occluded), 0u) << nameOf(settings);
        }
    }
}

/// A kernel that counts finds the same, and has something to count.
TEST_F(Layouts, CountingChangesNoHit) {
    const Scene scene = instancedSoup();
    const std::vector<shared::RayData> rays = randomRays(scene, 2000, 98);
    for (const RenderSettings& layout : everyLayout()) {
        RayCaster caster(device_, scene, twoLevels(layout));
        const CountedHits counted = caster.count(rays, false);
        EXPECT_EQ(countDifferentHits(counted.hits, caster.closest(rays)), 0u) << layout.layout;
        size_t nodes = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            const shared::RayCounts& c = counted.counts[i];
            nodes += c.nodes;
            const uint32_t hits = counted.hits[i].t >= 0.0f ? 1u : 0u;
            EXPECT_GE(c.primitivesHit, hits) << layout.layout;
            EXPECT_GE(c.primitivesTested, c.primitivesHit) << layout.layout;
            EXPECT_GE(c.instances, hits) << layout.layout;
            EXPECT_GE(c.boxesTested, c.boxesHit) << layout.layout;
            EXPECT_GE(c.boxesTested, c.nodes) << layout.layout;
            EXPECT_GE(c.steps, c.nodes) << layout.layout;
            EXPECT_LE(c.stackHigh, caster.prepared().tracer->traceData().stackEntries) << layout.layout;
        }
        EXPECT_GT(nodes, rays.size()) << layout.layout;
    }
}

}  // namespace
}  // namespace raylab::support
