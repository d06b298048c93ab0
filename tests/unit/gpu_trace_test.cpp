#include "engine/scene/import.h"
#include "tests/support/gpu_test.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

/// The default traversal on the device against the oracle; the others: gpu_layouts_test.cpp.
namespace raylab::support {
namespace {

using accel_test::Random;

class TraceOracle : public GpuTest {
protected:
    Agreement compare(const Scene& scene, const OracleCase& oracle, const RenderSettings& settings = {}) {
        RayCaster caster(device_, scene, settings);
        return compareWithOracle(caster, oracle);
    }
};

TEST_F(TraceOracle, RandomSoup) {
    const Scene scene = soupScene(10000, 0.05f);
    expectAgreement(compare(scene, OracleCase(scene, randomRays(scene, 4000, 82), 1e-4)), 4000);
    expectAgreement(compare(scene, OracleCase(scene, randomRays(scene, 500, 89), 1e-4), bruteForce({})), 500);
}

/// 871,414 triangles of 5e-4, whose positions carry 1e-4 of their size.
TEST_F(TraceOracle, Dragon) {
    const std::optional<std::filesystem::path> path = sharedScene("stanford-dragon/dragon_vrip.ply");
    if (!path) return;
    const Scene scene = importScene(*path);
    expectAgreement(compare(scene, OracleCase(scene, randomRays(scene, 100, 85), 2e-3)), 100);
}

/// Large walls beside small ornaments.
TEST_F(TraceOracle, Sponza) {
    const std::optional<std::filesystem::path> path = sharedScene("sponza-crytek/Sponza.gltf");
    if (!path) return;
    Scene scene = importScene(*path);
    makeSolid(scene);
    expectAgreement(compare(scene, OracleCase(scene, randomRays(scene, 400, 86), 1e-3)), 400);
}

TEST_F(TraceOracle, RaysAlongAxesAndInFaces) {
    const Scene scene = gridOfCubes();
    std::vector<shared::RayData> offFaces;
    for (const shared::RayData& ray : raysAlongAxes(40000, 87))
        if (ray.tMin > 0.0f) offFaces.push_back(ray);  // at a face, t is 0 but for rounding: not decidable from 0 on
    const Agreement agreement = compare(scene, OracleCase(scene, offFaces, 1e-4));
    EXPECT_EQ(agreement.wrongHits, 0u);
    EXPECT_EQ(agreement.wrongDistances, 0u);
    EXPECT_EQ(agreement.wrongShadows, 0u);
    EXPECT_GT(agreement.hits, 500u);
}

/// Of 200 equal triangles the lowest id wins, whatever the tree does.
TEST_F(TraceOracle, LowestIdWinsAmongDuplicates) {
    Scene scene;
    const uint32_t material = addMaterial(scene, lambert(0.5f));
    accel_test::TestMesh mesh;
    for (int i = 0; i < 200; ++i) mesh.add({-1, -1, 0}, {3, -1, 0}, {-1, 3, 0});
    addMesh(scene, meshOf(mesh, material));
    addMesh(scene, meshOf(mesh, material));
    RayCaster caster(device_, scene, {});
    Random random(88);
    std::vector<shared::RayData> rays;
    for (int i = 0; i < 1000; ++i)
        rays.push_back(makeRay({random.uniform(-0.4f, 0.9f), random.uniform(-0.4f, 0.9f), 2.0f}, {0, 0, -1}));
    for (const shared::HitData& hit : caster.closest(rays)) {
        EXPECT_EQ(hit.t, 2.0f);
        EXPECT_EQ(hit.instance, 0u);
        EXPECT_EQ(hit.primitive, 0u);
    }
}

}  // namespace
}  // namespace raylab::support
