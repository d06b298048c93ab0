#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>

#include "engine/gpu/device.h"
#include "engine/measure/stability/ray_sets.h"
#include "engine/measure/stability/render_case.h"
#include "engine/render/renderer.h"
#include "engine/scene/scene.h"
#include "shaders/shared/frame.h"

/// What the tests on a device share.
namespace raylab::support {

/// The one device of the test executable, made at the first call, with Vulkan validation.
Device& sharedDevice();

/// A test that uses the device; any message of the validation layers fails it.
class GpuTest : public ::testing::Test {
protected:
    Device& device_ = sharedDevice();
    void TearDown() override { EXPECT_EQ(device_.validationMessageCount(), 0u) << "the messages are in the log above"; }
};

/// A square image of few pixels, with settings that a test then changes. Light comes from the scene alone.
RenderSettings smallImage(int64_t size, int64_t spp, int64_t depth);

using stability::renderFilm;

using stability::makeRay;

/// The shared scenes beside the repository, or nothing, and a line that says so.
std::optional<std::filesystem::path> sharedScene(const std::string& relativePath);

}  // namespace raylab::support
