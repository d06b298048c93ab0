#include "ui/editor/model/edit_surroundings.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "engine/core/error.h"
#include "engine/image/image_io.h"

namespace raylab::editor {
namespace {

SkyDescription settled(SkyDescription sky) {
    const float quarter = glm::radians(90.0f), turn = glm::radians(360.0f);
    sky.sunElevationRadians = std::clamp(sky.sunElevationRadians, -quarter, quarter);
    sky.sunAzimuthRadians = std::clamp(sky.sunAzimuthRadians, -turn, turn);
    sky.turbidity = std::clamp(sky.turbidity, 1.0f, 10.0f);
    sky.scale = std::clamp(sky.scale, 0.0f, 1e6f);
    return sky;
}

SharedOptional<Environment> readEnvironment(const std::filesystem::path& file) {
    Environment environment{.radiance = readImage(file)};
    for (float& value : environment.radiance.pixels)
        if (!(std::isfinite(value) && value >= 0.0f)) value = 0.0f;
    return environment;
}

}  // namespace

Edit setSky(const SkyDescription& sky, std::string mergeKey) {
    return {"Change sky",
            [sky = settled(sky)](EditState& state) {
                state.scene.sky = sky;
                state.scene.environment.reset();
            },
            std::move(mergeKey)};
}

Edit loadEnvironment(const std::filesystem::path& file) {
    return {"Light by " + file.filename().string(), [environment = readEnvironment(file)](EditState& state) {
                state.scene.environment = environment;
                state.scene.sky.reset();
            }};
}

Edit removeSurroundings() {
    return {"Remove surroundings", [](EditState& state) {
                state.scene.environment.reset();
                state.scene.sky.reset();
            }};
}

Edit setRenderSetting(const std::string& name, const std::string& text, std::string mergeKey) {
    return {
        "Set " + name,
        [name, text](EditState& state) { setSetting(findSetting(renderSettingsTable(), name), state.settings, text); },
        std::move(mergeKey)};
}

Edit replaceRenderSettings(const RenderSettings& settings, const std::string& name) {
    return {name, [settings](EditState& state) { state.settings = settings; }};
}

}  // namespace raylab::editor
