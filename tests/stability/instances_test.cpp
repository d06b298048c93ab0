#include <glm/gtc/matrix_transform.hpp>

#include "engine/core/error.h"
#include "engine/scene/import.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

/// S11: matrices of all kinds, and no instance at all. S12: scenes that are very small or very large.
namespace raylab::support {
namespace {

/// Every mesh is shown once more, far to the side: by instances where they are kept.
Scene shownTwice(Scene scene) {
    const size_t count = scene.instances.size();
    for (size_t i = 0; i < count; ++i) {
        Instance again = scene.instances[i];
        again.objectToWorld = glm::translate(glm::mat4(1.0f), {7.0f, 1.0f, 2.0f}) * again.objectToWorld;
        scene.instances.push_back(again);
    }
    return scene;
}

class Instances : public GpuTest {
protected:
    /// Every layout, flattened and below instances.
    void expectOraclesHits(const Scene& scene, std::vector<shared::RayData> rays, double margin) {
        const OracleCase oracle(scene, std::move(rays), margin);
        for (const RenderSettings& layout : everyLayout())
            for (const RenderSettings& settings : {layout, twoLevels(layout)}) {
                RayCaster caster(device_, scene, settings);
                const Agreement agreement = compareWithOracle(caster, oracle);
                EXPECT_EQ(agreement.wrongHits, 0u) << nameOf(settings);
                EXPECT_EQ(agreement.wrongShadows, 0u) << nameOf(settings);
                EXPECT_GT(agreement.hits, oracle.rays.size() / 20) << nameOf(settings);
            }
    }
    void expectTruckIsHit(const std::string& file) {
        const std::optional<std::filesystem::path> path = sharedScene("derived-edge-cases/" + file);
        if (!path) return;
        Scene scene = shownTwice(importScene(*path));
        makeSolid(scene);
        expectOraclesHits(scene, randomRays(scene, 4000, 161), 1e-3);
    }
};

TEST_F(Instances, MirroredTruck) { expectTruckIsHit("truck_mirror_x.gltf"); }

TEST_F(Instances, ShearedTruck) { expectTruckIsHit("truck_nonuniform_sheared.gltf"); }

TEST_F(Instances, SingularIsLeftOutWithAMessage) {
    const std::optional<std::filesystem::path> path = sharedScene("derived-edge-cases/truck_singular.gltf");
    if (!path) return;
    try {
        importScene(*path);
        ADD_FAILURE() << "every instance of it is singular";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("left out for a singular"), std::string::npos) << error.what();
    }
}

TEST_F(Instances, MeshesWithoutAnInstanceAreMissed) {
    Scene scene = soupScene(1000, 0.3f);
    const std::vector<shared::RayData> rays = randomRays(scene, 1000, 162);
    scene.instances.clear();
    for (const RenderSettings& settings : everyLayout()) {
        RayCaster caster(device_, scene, twoLevels(settings));
        for (const shared::HitData& hit : caster.closest(rays)) EXPECT_LT(hit.t, 0.0f) << nameOf(settings);
    }
}

/// As far as ties: the ids that the oracle finds at unit scale are those of the scaled scene.
TEST_F(Instances, ScaleDoesNotShow) {
    const Scene unit = instancedSoup();
    const OracleCase oracle(unit, randomRays(unit, 4000, 163), 1e-3);
    for (const float scale : {1e-4f, 1e4f}) {
        Scene scene = unit;
        for (Instance& instance : scene.instances)
            instance.objectToWorld = glm::scale(glm::mat4(1.0f), glm::vec3(scale)) * instance.objectToWorld;
        std::vector<shared::RayData> rays = oracle.rays;
        for (shared::RayData& ray : rays) ray.origin *= scale;
        for (const RenderSettings& layout : everyLayout())
            for (const RenderSettings& settings : {layout, twoLevels(layout)}) {
                RayCaster caster(device_, scene, settings);
                const std::vector<shared::HitData> hits = caster.closest(rays);
                size_t wrong = 0;
                for (size_t i = 0; i < hits.size(); ++i)
                    wrong += isDecidable(oracle.expected[i], oracle.margin) && !oracle.isHit(i, hits[i]) ? 1u : 0u;
                EXPECT_EQ(wrong, 0u) << nameOf(settings) << " at " << scale;
            }
    }
}

/// S12: a bead of 1e-3 beside a plane of 1e4. The error of a distance grows with the triangle, not with the distance:
/// measured on lavapipe, 52 of 4000 rays see bead and plane in the wrong order, in every layout. Twice that is the
/// bound.
TEST_F(Instances, BeadBesideALargePlane) {
    Scene scene = sceneOf(accel_test::sphere(1e-3f, 16, 32, {0.0f, 2e-3f, 0.0f}));
    std::vector<shared::RayData> rays = randomRays(scene, 4000, 164);
    addMesh(scene, floorQuad(0, 1e4f));
    const OracleCase oracle(scene, std::move(rays), 1e-3);
    for (const RenderSettings& settings : everyLayout()) {
        RayCaster caster(device_, scene, settings);
        const Agreement agreement = compareWithOracle(caster, oracle);
        EXPECT_LE(agreement.wrongHits, 104u) << nameOf(settings);
        EXPECT_GT(agreement.hits, oracle.rays.size() / 4) << nameOf(settings);
    }
}

}  // namespace
}  // namespace raylab::support
