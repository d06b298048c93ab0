#include "engine/render/lighting.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "engine/core/error.h"
#include "engine/image/image_io.h"
#include "engine/scene/sky.h"

namespace raylab {
namespace {

Environment constantEnvironment(float radiance) {
    Environment environment{Bitmap(1, 1, 3)};
    std::fill(environment.radiance.pixels.begin(), environment.radiance.pixels.end(), radiance);
    return environment;
}

SkyDescription skyOf(const Scene& scene, const RenderSettings& settings) {
    SkyDescription sky = scene.sky.value_or(SkyDescription{});
    if (settings.sunElevation >= 0.0) sky.sunElevationRadians = glm::radians(static_cast<float>(settings.sunElevation));
    if (settings.sunAzimuth >= 0.0) sky.sunAzimuthRadians = glm::radians(static_cast<float>(settings.sunAzimuth));
    return sky;
}

/// What `auto` means for this scene.
SharedOptional<Environment> ownEnvironment(Scene& scene, const RenderSettings& settings) {
    const bool asksForSun = settings.sunElevation >= 0.0 || settings.sunAzimuth >= 0.0;
    if (scene.sky || asksForSun) return makeSky(skyOf(scene, settings));
    if (scene.environment) return scene.environment;
    if (hasLight(scene)) return std::nullopt;
    scene.warnings.push_back("no light in the scene: a sky with a sun is added (--environment and --sun-elevation choose another)");
    return makeSky(skyOf(scene, settings));
}

SharedOptional<Environment> chosenEnvironment(Scene& scene, const RenderSettings& settings) {
    const std::string& choice = settings.environment;
    if (choice == "auto") return ownEnvironment(scene, settings);
    if (choice == "none") return std::nullopt;
    if (choice == "white") return constantEnvironment(1.0f);
    if (choice == "sky") return makeSky(skyOf(scene, settings));
    if (!std::filesystem::exists(choice))
        throw Error("--environment " + choice + ": no such file, nor auto, none, sky or white");
    return Environment{readImage(choice)};
}

}  // namespace

bool hasLight(const Scene& scene) {
    const bool emits = std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& mesh) {
        return glm::any(glm::greaterThan(scene.materials[mesh.material].emission, glm::vec3(0.0f)));
    });
    return emits || !scene.lights.empty() || scene.environment || scene.sky;
}

void settleEnvironment(Scene& scene, const RenderSettings& settings) {
    SharedOptional<Environment> chosen = chosenEnvironment(scene, settings);
    scene.environment = std::move(chosen);
    if (!scene.environment) return;
    if (scene.environment->parts) {
        scene.environment->parts->sunIrradiance *= static_cast<float>(settings.environmentScale);
        scene.environment->parts->skyRadiance *= static_cast<float>(settings.environmentScale);
    }
    size_t mended = 0;
    for (float& value : scene.environment->radiance.pixels) {
        value *= static_cast<float>(settings.environmentScale);
        if (std::isfinite(value) && value >= 0.0f) continue;
        value = 0.0f;
        ++mended;
    }
    if (mended > 0)
        scene.warnings.push_back("the environment has " + std::to_string(mended) +
                                 " values that are negative or not finite; they count as 0");
}

}  // namespace raylab
