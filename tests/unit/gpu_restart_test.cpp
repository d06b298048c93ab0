#include "engine/render/camera.h"
#include "engine/scene/import.h"
#include "tests/support/gpu_test.h"
#include "tests/support/paths.h"

namespace raylab::support {
namespace {

/// A renderer that starts over must not remember what it rendered before: it is compared with one that is new.
class Restart : public GpuTest {
protected:
    static FilmImage finish(Renderer& renderer) {
        while (renderer.step()) continue;
        return renderer.snapshot();
    }
    void expectAsNew(Renderer& restarted, const Scene& scene, const RenderSettings& settings) {
        Renderer fresh(device_, scene, settings);
        EXPECT_EQ(finish(restarted).mean.pixels, finish(fresh).mean.pixels);
    }

    Scene scene_ = importScene(binaryFolder() / "assets/cornell.glb");
    RenderSettings settings_ = smallImage(16, 6, 3);
};

TEST_F(Restart, AnotherCameraSizeAndMethod) {
    Renderer renderer(device_, scene_, settings_);
    finish(renderer);
    settings_.width = 21;
    settings_.seed = 5;
    settings_.camera = "278,300,-700,278,250,0,50";
    renderer.restart(settings_, chooseCamera(scene_, settings_.camera));
    expectAsNew(renderer, scene_, settings_);
    settings_.integrator = "normal";
    renderer.restart(settings_, chooseCamera(scene_, settings_.camera));
    expectAsNew(renderer, scene_, settings_);
}

TEST_F(Restart, AnotherMaterial) {
    Renderer renderer(device_, scene_, settings_);
    finish(renderer);
    for (Material& material : scene_.materials) material.baseColor *= 0.5f;
    renderer.updateShading(scene_);
    expectAsNew(renderer, scene_, settings_);
}

TEST_F(Restart, AMovedInstance) {
    settings_.trees = "mesh";
    Renderer renderer(device_, scene_, settings_);
    finish(renderer);
    scene_.instances.back().objectToWorld[3].x += 40.0f;
    renderer.update(scene_, {.instances = true, .meshes = {}});
    expectAsNew(renderer, scene_, settings_);
}

}  // namespace
}  // namespace raylab::support
