#pragma once

#include <filesystem>
#include <string>

#include "engine/gpu/device.h"
#include "engine/image/image_io.h"
#include "engine/render/renderer.h"
#include "engine/scene/scene.h"

namespace raylab {

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
    std::string stoppedBy;  ///< samples, time-limit, target-error or interrupt
    float sceneDiagonal = 0.0f;
};

/// Renders until samples, time, error or the user say stop.
RenderResult renderUntilDone(Device& device, const Scene& scene, const RenderSettings& settings, bool quiet);

/// Throws Error unless the extension is one that writeRender writes.
void requireImageExtension(const std::filesystem::path& path);

/// PNG (exposure, tonemap), HDR or EXR (radiance; variance and samples as layers), with the metadata inside.
void writeRender(const std::filesystem::path& path, const RenderResult& result, const RenderSettings& settings,
                 const Metadata& metadata);

}  // namespace raylab
