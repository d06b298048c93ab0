#include "engine/scene/gltf_extras.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "engine/core/error.h"
#include "engine/image/image_io.h"
#include "engine/scene/resource_path.h"

namespace raylab {
namespace {

SkyDescription readSky(const JsonView& sun) {
    SkyDescription sky;
    sky.sunElevationRadians = static_cast<float>(glm::radians(numberBetween(sun, "elevation", -90.0, 90.0, 45.0)));
    sky.sunAzimuthRadians = static_cast<float>(glm::radians(numberBetween(sun, "azimuth", -360.0, 360.0, 0.0)));
    sky.turbidity = static_cast<float>(numberBetween(sun, "turbidity", 1.0, 10.0, 2.5));
    sky.scale = static_cast<float>(numberBetween(sun, "scale", 0.0, 1e6, 1.0));
    return sky;
}

void scaleAndClean(Bitmap& radiance, float scale, std::vector<std::string>& warnings) {
    size_t repaired = 0;
    for (float& value : radiance.pixels) {
        value *= scale;
        if (std::isfinite(value) && value >= 0.0f) continue;
        value = 0.0f;
        ++repaired;
    }
    if (repaired > 0)
        warnings.push_back(std::to_string(repaired) +
                           " values of the environment were negative or not finite, taken as 0");
}

void readEnvironment(const GltfDocument& document, const JsonView& extras, Scene& scene) {
    const auto file = resolveResource(document.path.parent_path(), extras.text("environment", ""));
    const auto scale = static_cast<float>(numberBetween(extras, "environmentScale", 0.0, 1e6, 1.0));
    try {
        Environment environment{.radiance = readImage(file)};
        scaleAndClean(environment.radiance, scale, scene.warnings);
        scene.environment = std::move(environment);
    } catch (const Error& problem) {
        scene.warnings.push_back(std::string("the environment was left out: ") + problem.what());
    }
}

}  // namespace

double numberBetween(const JsonView& owner, const char* key, double low, double high, double fallback) {
    const double value = owner.number(key, fallback);
    if (value < low || value > high)
        owner.fail(std::string("needs ") + key + " between " + std::to_string(low) + " and " + std::to_string(high));
    return value;
}

std::optional<JsonView> raylabExtras(const JsonView& owner) {
    if (!owner.has("extras") || !owner.json()["extras"].is_object()) return std::nullopt;
    const JsonView extras = owner.object("extras");
    if (!extras.has("raylab")) return std::nullopt;
    return extras.object("raylab");
}

std::optional<JsonView> sceneExtras(const JsonView& root) {
    const JsonView scenes = root.array("scenes");
    if (scenes.size() > 0)
        if (auto found = raylabExtras(scenes.element(root.index("scene", scenes.size()).value_or(0)))) return found;
    return raylabExtras(root);
}

void readGltfExtras(const GltfDocument& document, Scene& scene) {
    const std::optional<JsonView> extras = sceneExtras(document.root());
    if (!extras) return;
    if (extras->has("environment")) readEnvironment(document, *extras, scene);
    if (extras->has("sun")) scene.sky = readSky(extras->object("sun"));
}

}  // namespace raylab
