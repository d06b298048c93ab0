#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/core/error.h"
#include "tests/support/trace_choice.h"
#include "tests/support/trace_oracle.h"
#include "tests/support/trace_rays.h"

/// A scene that changes on the device is the scene that is built anew.
namespace raylab::support {
namespace {

void moveInstances(Scene& scene) {
    for (size_t i = 0; i < scene.instances.size(); i += 2)
        scene.instances[i].objectToWorld = glm::translate(glm::mat4(1.0f), {0.3f, -0.2f, 0.1f * float(i % 5)}) *
                                           glm::rotate(glm::mat4(1.0f), 0.7f, {0, 1, 0}) * scene.instances[i].objectToWorld;
}

void deform(Mesh& mesh) {
    for (glm::vec3& p : mesh.positions) p += 0.2f * glm::vec3(std::sin(3.0f * p.y), std::sin(4.0f * p.z), std::cos(5.0f * p.x));
}

class Update : public GpuTest {
protected:
    void expectAsBuiltAnew(const std::function<SceneChange(Scene&)>& change) {
        Scene scene = instancedSoup();
        const std::vector<shared::RayData> rays = randomRays(scene, 4000, 311);
        std::vector<RenderSettings> choices = everyLayout();
        for (const RenderSettings& settings : everyTracer(device_.description())) choices.push_back(settings);
        for (RenderSettings settings : choices) {
            settings.trees = "mesh";
            Scene changed = instancedSoup();
            RayCaster caster(device_, changed, settings);
            caster.closest(rays);
            caster.update(changed, change(changed));
            RayCaster anew(device_, changed, settings);
            const std::vector<shared::HitData> got = caster.closest(rays), expected = anew.closest(rays);
            size_t different = 0, differentShadows = 0;
            const std::vector<shared::HitData> shadows = caster.occluded(rays), expectedShadows = anew.occluded(rays);
            for (size_t i = 0; i < rays.size(); ++i) {
                different += isSameHit(got[i], expected[i]) ? 0u : 1u;
                differentShadows += (shadows[i].t < 0.0f) != (expectedShadows[i].t < 0.0f) ? 1u : 0u;
            }
            EXPECT_EQ(different, 0u) << nameOf(settings);
            EXPECT_EQ(differentShadows, 0u) << nameOf(settings);
        }
    }
};

TEST_F(Update, MovedInstances) {
    expectAsBuiltAnew([](Scene& scene) {
        moveInstances(scene);
        return SceneChange{.instances = true};
    });
}

TEST_F(Update, DeformedMesh) {
    expectAsBuiltAnew([](Scene& scene) {
        deform(scene.meshes[0]);
        return SceneChange{.meshes = {0}};
    });
}

TEST_F(Update, MergedTreesCannotBeMoved) {
    Scene scene = instancedSoup();
    RayCaster caster(device_, scene, {});
    EXPECT_THROW(caster.update(scene, {.instances = true}), Error);
}

}  // namespace
}  // namespace raylab::support
