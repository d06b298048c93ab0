#include "ui/editor/model/settled_environment.h"

#include <tuple>

#include "engine/render/lighting.h"

namespace raylab::editor {

bool SettledEnvironment::Key::operator==(const Key& other) const {
    const auto plain = [](const Key& key) {
        return std::tie(key.sky, key.hasLight, key.choice, key.scale, key.sunElevation, key.sunAzimuth);
    };
    return own.sameAs(other.own) && plain(*this) == plain(other);
}

SettledEnvironment::Key SettledEnvironment::keyOf(const Scene& scene, const RenderSettings& settings) {
    return {scene.environment,     scene.sky,          hasLight(scene), settings.environment, settings.environmentScale,
            settings.sunElevation, settings.sunAzimuth};
}

void SettledEnvironment::settle(Scene& scene, const RenderSettings& settings) {
    Key key = keyOf(scene, settings);
    if (key_ != key) {
        key_.reset();
        settleEnvironment(scene, settings);
        settled_ = scene.environment;
        key_ = std::move(key);
    }
    scene.environment = settled_;
}

}  // namespace raylab::editor
