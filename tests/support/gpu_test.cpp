#include "tests/support/gpu_test.h"

#include <iostream>
#include <memory>

#include "tests/support/paths.h"

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
    settings.layout = kDefaultLayout;  // that large scenes have, however small a test's is
    return stability::smallImage(settings, size, spp, depth);
}

std::optional<std::filesystem::path> sharedScene(const std::string& relativePath) {
    std::filesystem::path path = sharedScenes() / relativePath;
    if (std::filesystem::exists(path)) return path;
    std::cout << "not run: shared/scenes/" << relativePath << " is not beside the repository\n";
    return std::nullopt;
}

}  // namespace raylab::support
