#include "tests/support/gpu_test.h"

#include <iostream>
#include <memory>

#include "engine/render/lighting.h"

namespace raylab::support {
namespace {

std::unique_ptr<Device> device;

/// Destroys the device before the program's other statics go, the validation layers' among them.
class DeviceEnvironment : public ::testing::Environment {
public:
    void TearDown() override { device.reset(); }
};

[[maybe_unused]] const ::testing::Environment* const environment =
    ::testing::AddGlobalTestEnvironment(new DeviceEnvironment);  // googletest owns it

}  // namespace

Device& sharedDevice() {
    if (!device) device = std::make_unique<Device>(DeviceOptions{"", true});
    return *device;
}

RenderSettings smallImage(int64_t size, int64_t spp, int64_t depth) {
    RenderSettings settings;
    settings.width = size;
    settings.height = size;
    settings.spp = spp;
    settings.depth = depth;
    settings.seed = 20240607;
    return settings;
}

FilmImage renderFilm(Device& onDevice, Scene scene, const RenderSettings& settings) {
    settleEnvironment(scene, settings);
    Renderer renderer(onDevice, scene, settings);
    while (renderer.step()) {
    }
    return renderer.snapshot();
}

shared::RayData makeRay(glm::vec3 origin, glm::vec3 direction, float tMin, float tMax) {
    return {origin, tMin, direction, tMax};
}

std::optional<std::filesystem::path> sharedScene(const std::string& relativePath) {
    std::filesystem::path path = std::filesystem::path(RAYLAB_SOURCE_DIR) / "../shared/scenes" / relativePath;
    if (std::filesystem::exists(path)) return path;
    std::cout << "not run: shared/scenes/" << relativePath << " is not beside the repository\n";
    return std::nullopt;
}

}  // namespace raylab::support
