#include "ui/editor/file_render.h"

#include <array>
#include <cstdio>
#include <memory>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/image/image8.h"
#include "engine/image/image_io.h"
#include "engine/render/device_recovery.h"
#include "engine/render/kernel_use.h"
#include "engine/render/lighting.h"
#include "engine/render/renderer.h"
#include "ui/editor/picture.h"

namespace raylab {
namespace {

constexpr double kLookInterval = 1.0;  ///< seconds between looks at the noise

void writeImage(const std::filesystem::path& path, const FilmImage& film, const RenderSettings& settings,
                float diagonal) {
    Metadata metadata;
    for (const Setting<RenderSettings>& setting : renderSettingsTable())
        metadata.emplace_back(setting.name, settingText(getSetting(setting, settings)));
    if (path.extension() == ".exr")
        writeExr(path, filmLayers(film), metadata);
    else
        writePng(path, displayImage(film.picture(), settings, diagonal), metadata);
    logInfo("rendered " + std::filesystem::absolute(path).string());
}

std::string progressText(const std::filesystem::path& path, double done) {
    std::array<char, 16> percent{};
    std::snprintf(percent.data(), percent.size(), "  %.0f %%", 100.0 * done);
    return "Rendering " + path.filename().string() + percent.data();
}

/// Brings the kernels of a traversal up to their sources.
void refreshKernels(ShaderSources& shaders, const std::string& traversal) {
    try {
        shaders.refresh([&](const std::string& entry) { return mayServe(entry, traversal); });
    } catch (const Error& error) {
        logWarning(std::string(error.what()) + "; the last kernels that compiled render");
    }
}

/// Nothing is written where the job is cancelled.
void renderOnce(Device& device, const Scene& scene, const RenderSettings& settings, const std::filesystem::path& path,
                ShaderSources& shaders, JobControl& control) {
    auto prepared = std::make_shared<PreparedScene>(prepareScene(device, scene, settings));
    refreshKernels(shaders, traversalOf(*prepared));
    Renderer renderer(device, std::move(prepared), settings);
    const Stopwatch watch;
    double nextLook = kLookInterval;
    bool enough = false;
    while (!enough && renderer.step()) {
        if (control.isCancelled()) return;
        if (watch.seconds() < nextLook) continue;
        nextLook = watch.seconds() + kLookInterval;
        control.report(progressText(path, renderer.fractionDone()));
        if (renderer.completeSamples() == 0) continue;
        enough = (settings.timeLimit > 0.0 && watch.seconds() >= settings.timeLimit) ||
                 (settings.targetError > 0.0 && renderer.completeSamples() > 1 &&
                  renderer.snapshot().estimatedRelativeError <= settings.targetError);
    }
    const FilmImage image = renderer.develop([&] { return control.isCancelled(); });
    if (!control.isCancelled()) writeImage(path, image, settings, renderer.sceneDiagonal());
}

}  // namespace

void renderImage(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                 const std::filesystem::path& path, ShaderSources& shaders, JobControl& control) {
    requireWritable(path);
    Scene settled = scene;
    settleEnvironment(settled, settings);
    settled.cameras.insert(settled.cameras.begin(), camera);
    RenderSettings own = settings;
    own.camera = "0";
    ReplaceableDevice device({settings.device, settings.validation});
    LossRecovery recovery;
    renderThroughLosses(device, own, recovery, [&](Device& here, const RenderSettings& now) {
        renderOnce(here, settled, now, path, shaders, control);
    });
}

}  // namespace raylab
