#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "engine/image/image_io.h"
#include "engine/render/device_recovery.h"
#include "engine/render/renderer.h"
#include "engine/scene/scene.h"

namespace raylab {

constexpr std::string_view kStoppedByLoss = "device-loss";

/// How a rendering went; the command line prints it and writes it as JSON.
struct RenderResult {
    FilmImage image;
    RenderTimes times;
    double importSeconds = 0.0;
    double totalSeconds = 0.0;
    uint32_t samples = 0;  ///< that every pixel has
    uint64_t pixelSamples = 0;
    size_t sceneBytes = 0;
    size_t traceBytes = 0;
    size_t filmBytes = 0;
    size_t queueBytes = 0;  ///< of a wavefront
    std::string stoppedBy;  ///< samples, time-limit, target-error, interrupt or device-loss
    uint32_t deviceLosses = 0;
    float sceneDiagonal = 0.0f;
};

/// Renders until samples, time, error or the user say stop.
RenderResult renderUntilDone(Device& device, const Scene& scene, const RenderSettings& settings, bool quiet);

/// The same; but after a loss of the device it begins anew as LossRecovery has it, which `settings` then say. Where that
/// does not help, the result is the last look at the noise, with at least
/// two samples a pixel and stoppedBy device-loss; without one it throws DeviceLost.
RenderResult renderDespiteLosses(ReplaceableDevice& device, const Scene& scene, RenderSettings& settings, bool quiet);

/// Throws Error unless the extension is one that writeRender writes.
void requireImageExtension(const std::filesystem::path& path);

/// PNG (exposure, tonemap), HDR or EXR (radiance; variance and samples as layers), with the metadata inside.
void writeRender(const std::filesystem::path& path, const RenderResult& result, const RenderSettings& settings,
                 const Metadata& metadata);

}  // namespace raylab
