#include <gtest/gtest.h>

#include <filesystem>

#include "engine/core/error.h"
#include "engine/image/image_io.h"
#include "engine/render/lighting.h"
#include "tests/editor/model_support.h"
#include "ui/editor/model/settled_environment.h"

/// Scenes that follow one another share an environment as long as nothing of it changes, and have the one that
/// settleEnvironment() makes of each.
namespace raylab::editortest {
namespace {

Environment mapOf(float radiance) {
    Environment map{Bitmap(4, 2, 3)};
    for (float& value : map.radiance.pixels) value = radiance;
    return map;
}

void expectAsSettled(const Scene& got, Scene scene, const RenderSettings& settings) {
    settleEnvironment(scene, settings);
    ASSERT_EQ(got.environment.has_value(), scene.environment.has_value());
    if (scene.environment) {
        EXPECT_EQ(got.environment->radiance.pixels, scene.environment->radiance.pixels);
    }
}

TEST(SettledEnvironment, IsSharedUntilItChanges) {
    SettledEnvironment settled;
    Scene file = smallScene();
    file.environment = mapOf(2.0f);
    file.sky.reset();
    RenderSettings settings;
    const auto settle = [&] {
        Scene scene = file;
        settled.settle(scene, settings);
        expectAsSettled(scene, file, settings);
        return scene.environment;
    };
    const SharedOptional<Environment> first = settle();
    file.materials[0].baseColor *= 0.5f;
    file.lights.clear();
    settings.depth = 3;
    EXPECT_TRUE(settle().sameAs(first));
    settings.environmentScale = 3.0;
    const SharedOptional<Environment> scaled = settle();
    EXPECT_FALSE(scaled.sameAs(first));
    EXPECT_EQ(scaled->radiance.pixels.front(), 6.0f);
    settings.sunElevation = 0.5;
    EXPECT_FALSE(settle().sameAs(scaled));
    settings.environment = "none";
    EXPECT_FALSE(settle().has_value());
    settings.environment = "auto";
    settings.sunElevation = RenderSettings{}.sunElevation;
    file.environment = mapOf(1.0f);
    EXPECT_EQ(std::as_const(*settle()).radiance.pixels.front(), 3.0f);
}

/// A scene that loses its last light gets a sky.
TEST(SettledEnvironment, FollowsTheLights) {
    SettledEnvironment settled;
    Scene dark = smallScene();
    dark.environment = std::nullopt;
    dark.sky.reset();
    for (Material& material : dark.materials) material.emission = glm::vec3(0.0f);
    dark.lights.assign(1, Light{});
    Scene lit = dark;
    settled.settle(lit, {});
    EXPECT_FALSE(lit.environment.has_value());
    dark.lights.clear();
    settled.settle(dark, {});
    EXPECT_TRUE(dark.environment.has_value());
}

/// A file is read again once it is asked for, and after it could not be read.
TEST(SettledEnvironment, ReadsFilesAnewWhenTold) {
    const ScratchFolder folder;
    const std::filesystem::path file = folder.path() / "map.hdr";
    SettledEnvironment settled;
    RenderSettings settings;
    settings.environment = file.string();
    Scene scene = smallScene();
    EXPECT_THROW(settled.settle(scene, settings), Error);
    const auto brightness = [&] {
        Scene next = smallScene();
        settled.settle(next, settings);
        return std::as_const(*next.environment).radiance.pixels.front();
    };
    writeHdr(file, mapOf(1.0f).radiance);
    EXPECT_EQ(brightness(), 1.0f);
    writeHdr(file, mapOf(2.0f).radiance);
    EXPECT_EQ(brightness(), 1.0f);
    settled.forget();
    EXPECT_EQ(brightness(), 2.0f);
}

}  // namespace
}  // namespace raylab::editortest
