#include <cstdio>

#include "engine/measure/embree_caster.h"
#include "engine/scene/import.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

/// The default traversal against Embree; where the two differ, the double-precision oracle must say that no float can
/// decide. The house has 153 triangles without an area, the engine 10,413 with the same vertex twice (S8).
namespace raylab::support {
namespace {

class Embree : public GpuTest {
protected:
    void expectAgreement(const std::string& scenePath, size_t count, double margin) {
        const std::optional<std::filesystem::path> path = sharedScene(scenePath);
        if (!path) return;
        Scene scene = importScene(*path);
        makeSolid(scene);
        const Flattened flat = flatten(scene);
        const std::vector<shared::RayData> rays = randomRays(scene, count, 151);
        if (!hasEmbree()) GTEST_SKIP() << "built without Embree";
        const std::vector<shared::HitData> theirs = makeEmbreeCaster(scene, true)->closest(rays);
        RayCaster caster(device_, scene, {});
        const std::vector<shared::HitData> ours = caster.closest(rays);
        std::vector<shared::RayData> disputed;
        size_t met = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            met += ours[i].t >= 0.0f ? 1u : 0u;
            const bool same = (ours[i].t >= 0.0f) == (theirs[i].t >= 0.0f) &&
                              (ours[i].t < 0.0f ||
                               (ours[i].instance == theirs[i].instance && ours[i].primitive == theirs[i].primitive));
            if (!same) disputed.push_back(rays[i]);
        }
        size_t decidable = 0;
        for (const OracleHit& hit : oracleHits(flat, disputed)) decidable += isDecidable(hit, margin) ? 1u : 0u;
        std::printf("%zu rays, %zu hits, %zu disputed\n", rays.size(), met, disputed.size());
        EXPECT_EQ(decidable, 0u) << "of " << disputed.size() << " disputed hits";
        EXPECT_LT(disputed.size(), rays.size() / 100);
        EXPECT_GT(met, rays.size() / 10);
    }
};

TEST_F(Embree, Sponza) { expectAgreement("sponza-crytek/Sponza.gltf", 100'000, 1e-3); }

TEST_F(Embree, Dragon) { expectAgreement("stanford-dragon/dragon_vrip.ply", 100'000, 2e-3); }

TEST_F(Embree, House) { expectAgreement("victorian-house/house.glb", 100'000, 1e-3); }

TEST_F(Embree, EngineWithDegenerateTriangles) {
    expectAgreement("gltf-features/2CylinderEngine/glTF-Binary/2CylinderEngine.glb", 100'000, 1e-3);
}

}  // namespace
}  // namespace raylab::support
