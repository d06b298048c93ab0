#include "ui/editor/measured_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "engine/render/camera.h"

namespace raylab {

MeasuredScene measuredScene(const EditorContext& context) {
    const std::shared_ptr<const Scene> scene = context.state.document->rendered();
    const Camera& view = context.state.camera;
    const auto same = std::ranges::find(scene->cameras, view);
    if (same != scene->cameras.end()) return {scene, std::to_string(same - scene->cameras.begin())};
    if (view.up == glm::vec3(0.0f, 1.0f, 0.0f)) return {scene, cameraNumbers(view)};
    auto copy = std::make_shared<Scene>(*scene);
    copy->cameras.insert(copy->cameras.begin(), view);
    return {copy, "0"};
}

RenderSettings measuredSettings(RenderSettings settings, const RenderSettings& document, const std::string& camera,
                                int width) {
    const double aspect = static_cast<double>(document.height) / static_cast<double>(document.width);
    settings.width = width;
    settings.height = std::max<int64_t>(std::lround(aspect * width), 1);
    settings.camera = camera;
    settings.cameraEnd = document.cameraEnd;
    settings.seed = document.seed;
    settings.timeLimit = settings.targetError = 0.0;
    settings.exposure = document.exposure;
    settings.tonemap = document.tonemap;
    settings.device = document.device;
    settings.validation = document.validation;
    return settings;
}

std::string progressText(const std::string& what, double done) {
    std::array<char, 16> percent{};
    std::snprintf(percent.data(), percent.size(), "  %.0f %%", 100.0 * done);
    return what + percent.data();
}

}  // namespace raylab
