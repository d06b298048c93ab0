#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <optional>

#include "engine/core/error.h"
#include "engine/render/device_defaults.h"
#include "tests/support/scene_build.h"
#include "tests/support/scratch_folder.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

const DeviceDescription kDevice{.name = "a device", .driver = "1.0"};
const DeviceDescription kNewDriver{.name = "a device", .driver = "1.1"};

class DeviceDefaults : public testing::Test {
protected:
    void SetUp() override {
        const char* const before = std::getenv("XDG_CONFIG_HOME");
        if (before != nullptr) before_ = before;
        ::setenv("XDG_CONFIG_HOME", folder_.path().c_str(), 1);
    }
    void TearDown() override {
        if (before_) ::setenv("XDG_CONFIG_HOME", before_->c_str(), 1);
        if (!before_) ::unsetenv("XDG_CONFIG_HOME");
    }
    void writeDefaults(const std::string& text) const {
        fs::create_directories(deviceDefaultsFile().parent_path());
        std::ofstream(deviceDefaultsFile(), std::ios::binary) << text;
    }
    /// The default holds, and a warning names the file.
    void expectIgnored(const std::string& text) const {
        writeDefaults(text);
        testing::internal::CaptureStderr();
        EXPECT_EQ(layoutForDevice(kDevice), kDefaultLayout) << text;
        EXPECT_NE(testing::internal::GetCapturedStderr().find(deviceDefaultsFile().string()), std::string::npos);
    }

    const support::ScratchFolder folder_;
    std::optional<std::string> before_;
};

TEST_F(DeviceDefaults, NothingRecordedIsTheDefault) {
    EXPECT_EQ(layoutForDevice(kDevice), kDefaultLayout);
    EXPECT_EQ(deviceDefaultsFile(), folder_ / "raylab" / "devices.json");
}

TEST_F(DeviceDefaults, EachDeviceAndDriverHasItsOwn) {
    recordLayout(kDevice, "bvh2");
    recordLayout(kNewDriver, "bvh8q");
    recordLayout(kDevice, "bvh4q");
    EXPECT_EQ(layoutForDevice(kDevice), "bvh4q");
    EXPECT_EQ(layoutForDevice(kNewDriver), "bvh8q");
    EXPECT_EQ(layoutForDevice({.name = "another", .driver = "1.0"}), kDefaultLayout);
}

TEST_F(DeviceDefaults, OnlyAutoIsReplaced) {
    recordLayout(kDevice, "bvh2q");
    RenderSettings settings;
    EXPECT_EQ(resolveForDevice(settings, kDevice).layout, "bvh2q");
    settings.layout = "bvh2";
    EXPECT_EQ(resolveForDevice(settings, kDevice).layout, "bvh2");
}

/// A few primitives on show have a layout of their own: all of them count, however often a mesh is placed.
TEST_F(DeviceDefaults, TinyScenesHaveTheirOwnLayout) {
    recordLayout(kDevice, "bvh2q");
    Scene scene;
    const uint32_t mesh = support::addMesh(scene, support::box(0, glm::vec3(0.0f), glm::vec3(1.0f)));
    const size_t ofBox = scene.meshes[mesh].triangles.size();
    while (scene.instances.size() < kTinyPrimitives / ofBox) support::addInstance(scene, mesh, glm::mat4(1.0f));
    RenderSettings settings;
    EXPECT_EQ(traceConfig(settings, scene).layout, kTinyLayout);
    EXPECT_EQ(resolveForDevice(settings, kDevice, scene).layout, kTinyLayout);
    settings.layout = "bvh8q";
    EXPECT_EQ(traceConfig(settings, scene).layout, "bvh8q");
    EXPECT_EQ(resolveForDevice(settings, kDevice, scene).layout, "bvh8q");
    support::addInstance(scene, mesh, glm::mat4(1.0f));
    settings.layout = kAutoLayout;
    EXPECT_EQ(traceConfig(settings, scene).layout, kDefaultLayout);
    EXPECT_EQ(resolveForDevice(settings, kDevice, scene).layout, "bvh2q");
}

TEST_F(DeviceDefaults, BadFilesAreIgnoredWithAWarning) {
    recordLayout(kDevice, "bvh2");
    std::ifstream stream(deviceDefaultsFile());
    const std::string whole{std::istreambuf_iterator<char>(stream), {}};
    expectIgnored(whole.substr(0, whole.size() / 2));
    expectIgnored("");
    expectIgnored("[]");
    expectIgnored(R"({"schema": "another/1", "devices": []})");
    expectIgnored(R"({"schema": "raylab.device-defaults/1", "devices": [{"device": 3}]})");
    expectIgnored(R"({"schema": "raylab.device-defaults/1",
                      "devices": [{"device": "a device", "driver": "1.0", "layout": "bvh99"}]})");
    recordLayout(kDevice, "bvh2");
    EXPECT_EQ(layoutForDevice(kDevice), "bvh2");
}

TEST_F(DeviceDefaults, OnlyLayoutsAreRecorded) {
    EXPECT_THROW(recordLayout(kDevice, kAutoLayout), Error);
    EXPECT_FALSE(fs::exists(deviceDefaultsFile()));
}

TEST_F(DeviceDefaults, ARelativeConfigHomeIsNone) {
    ::setenv("XDG_CONFIG_HOME", "relative", 1);
    EXPECT_NE(deviceDefaultsFile().string().rfind("relative", 0), 0u);
}

}  // namespace
}  // namespace raylab
