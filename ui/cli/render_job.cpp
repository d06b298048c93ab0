#include "ui/cli/render_job.h"

#include <algorithm>
#include <array>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"
#include "engine/render/tonemap.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/progress.h"

namespace raylab {
namespace {

/// Reading the film back to estimate its noise costs time: at most so often, and never more than a twentieth of all.
constexpr double kNoiseInterval = 1.0;
constexpr double kNoiseShare = 0.05;

/// Estimates the film's noise from time to time.
class NoiseWatch {
public:
    double update(Renderer& renderer, const Stopwatch& rendering) {
        if (renderer.completeSamples() < 2 || rendering.seconds() < next_) return noise_;
        Stopwatch watch;
        noise_ = renderer.snapshot().estimatedRelativeError;
        next_ = rendering.seconds() + std::max(kNoiseInterval, watch.seconds() / kNoiseShare);
        return noise_;
    }

private:
    double noise_ = -1.0;
    double next_ = kNoiseInterval;
};

std::string renderLoop(Renderer& renderer, const RenderSettings& settings, bool quiet) {
    const InterruptGuard guard;
    Progress progress(quiet);
    NoiseWatch noise;
    const Stopwatch watch;
    while (renderer.step()) {
        const double error = noise.update(renderer, watch);
        const double ofTime = settings.timeLimit > 0.0 ? std::min(watch.seconds() / settings.timeLimit, 1.0) : 0.0;
        progress.show(std::max(renderer.fractionDone(), ofTime), renderer.completeSamples(), error);
        if (InterruptGuard::isInterrupted()) return "interrupt";
        const bool everyPixelHasOne = renderer.completeSamples() > 0;
        if (settings.timeLimit > 0.0 && watch.seconds() >= settings.timeLimit && everyPixelHasOne) return "time-limit";
        if (settings.targetError > 0.0 && error >= 0.0 && error <= settings.targetError) return "target-error";
    }
    return "samples";
}

/// Depth in units of the scene's diagonal; other views are colours already.
Bitmap displayOfView(const RenderResult& result, const IntegratorInfo& info) {
    Bitmap display = result.image.mean;
    if (info.name == "depth" && result.sceneDiagonal > 0.0f)
        for (float& value : display.pixels) value /= result.sceneDiagonal;
    return display;
}

}  // namespace

RenderResult renderUntilDone(Device& device, const Scene& scene, const RenderSettings& settings, bool quiet) {
    Renderer renderer(device, scene, settings);
    RenderResult result;
    result.stoppedBy = renderLoop(renderer, settings, quiet);
    result.image = renderer.snapshot();
    result.times = renderer.times();
    result.samples = renderer.completeSamples();
    result.pixelSamples = renderer.pixelSamples();
    result.sceneBytes = renderer.prepared().gpu->memoryBytes();
    result.traceBytes = renderer.prepared().tracer->memoryBytes();
    result.filmBytes = renderer.filmBytes();
    result.queueBytes = renderer.queueBytes();
    result.sceneDiagonal = renderer.sceneDiagonal();
    return result;
}

void requireImageExtension(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (extension != ".png" && extension != ".exr" && extension != ".hdr")
        throw Error(path.string() + ": images are written as .png, .exr or .hdr");
}

void writeRender(const std::filesystem::path& path, const RenderResult& result, const RenderSettings& settings,
                 const Metadata& metadata) {
    if (path.extension() == ".exr") {
        writeExr(path, std::array{Layer{"", result.image.mean}, Layer{"variance", result.image.variance},
                                  Layer{"samples", result.image.samples}},
                 metadata);
    } else if (path.extension() == ".hdr") {
        writeHdr(path, result.image.mean, metadata);
    } else {
        const IntegratorInfo& info = findIntegrator(settings.integrator);
        const Bitmap display = info.isView ? displayOfView(result, info)
                                           : tonemapImage(result.image.mean, settings.exposure, settings.tonemap);
        writePng(path, display, metadata);
    }
}

}  // namespace raylab
