#include "engine/render/prepared_settings.h"
#include "engine/scene/import.h"
#include "tests/support/gpu_test.h"
#include "tests/support/paths.h"

namespace raylab::support {
namespace {

class UpdatedSettings : public GpuTest {
protected:
    static std::vector<float> finish(Renderer& renderer) {
        while (renderer.step()) continue;
        return renderer.snapshot().mean.pixels;
    }
};

/// What prepareScene() keeps of the settings is taken up without it: the picture is that of a scene prepared by them,
/// and another than before.
TEST_F(UpdatedSettings, RenderAsIfPreparedByThem) {
    Scene scene = importScene(binaryFolder() / "assets/cornell.glb");
    scene.lights.push_back({.name = "lamp", .position = {200.0f, 400.0f, 200.0f}, .intensity = glm::vec3(4e4f)});
    RenderSettings settings = smallImage(16, 4, 3);
    const auto prepared = std::make_shared<PreparedScene>(prepareScene(device_, scene, settings));
    Renderer renderer(device_, prepared, settings);
    std::vector<float> before = finish(renderer);
    const std::vector<std::pair<std::string, std::string>> changes = {
        {"sampler", "blue-noise"}, {"integrator", "whitted"}, {"ambient", "0.5"}};
    for (const auto& [name, value] : changes) {
        SCOPED_TRACE(name + " " + value);
        setSetting(findSetting(renderSettingsTable(), name), settings, value);
        updateSettings(device_, scene, settings, *prepared);
        renderer.restart(settings, prepared->camera);
        Renderer fresh(device_, scene, settings);
        const std::vector<float> pixels = finish(renderer);
        EXPECT_EQ(pixels, finish(fresh));
        EXPECT_NE(pixels, before);
        before = pixels;
    }
}

}  // namespace
}  // namespace raylab::support
