#include "ui/cli/render_job.h"

#include <algorithm>
#include <optional>

#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/core/stopwatch.h"
#include "engine/render/tonemap.h"
#include "ui/cli/interrupt.h"
#include "ui/cli/progress.h"

namespace raylab {
namespace {

/// Reading the film back to estimate its noise costs time: at most so often, and never more than a twentieth of all.
constexpr double kNoiseInterval = 1.0;
constexpr double kNoiseShare = 0.05;

RenderResult resultOf(const Renderer& renderer, FilmImage image) {
    RenderResult result;
    result.image = std::move(image);
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

/// Estimates the film's noise from time to time, and leaves what it has seen in `last`.
class NoiseWatch {
public:
    explicit NoiseWatch(std::optional<RenderResult>& last) : last_(last) {}
    double update(Renderer& renderer, const Stopwatch& rendering) {
        if (renderer.completeSamples() < 2 || rendering.seconds() < next_) return noise_;
        Stopwatch watch;
        last_ = resultOf(renderer, renderer.snapshot());
        noise_ = last_->image.estimatedRelativeError;
        next_ = rendering.seconds() + std::max(kNoiseInterval, watch.seconds() / kNoiseShare);
        return noise_;
    }

private:
    std::optional<RenderResult>& last_;
    double noise_ = -1.0;
    double next_ = kNoiseInterval;
};

std::string renderLoop(Renderer& renderer, const RenderSettings& settings, bool quiet,
                       std::optional<RenderResult>& last) {
    const InterruptGuard guard;
    Progress progress(quiet);
    NoiseWatch noise(last);
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

/// The picture as the settings want it. Who has asked for an end, or asks for it now, gets it as it is, and so does who
/// wants it denoised where that fails. `last`: gets it before it is denoised.
FilmImage developPicture(Renderer& renderer, const RenderSettings& settings, std::string& stoppedBy,
                         std::optional<RenderResult>& last) {
    if (stoppedBy == "interrupt" || settings.denoise == kNoDenoiser) return renderer.snapshot();
    const InterruptGuard guard;
    last = resultOf(renderer, renderer.snapshot());
    try {
        FilmImage image = renderer.develop(InterruptGuard::isInterrupted);
        if (InterruptGuard::isInterrupted()) stoppedBy = "interrupt";
        return image;
    } catch (const DeviceLost&) {
        throw;
    } catch (const Error& error) {
        logWarning(std::string(error.what()) + "; the picture is not denoised");
        return last->image;
    }
}

/// `last`: gets what the last look at the noise has seen, lest a loss of the device takes all.
RenderResult renderOnce(Device& device, const Scene& scene, const RenderSettings& settings, bool quiet,
                        std::optional<RenderResult>& last) {
    Renderer renderer(device, scene, settings);
    std::string stoppedBy = renderLoop(renderer, settings, quiet, last);
    FilmImage image = developPicture(renderer, settings, stoppedBy, last);
    RenderResult result = resultOf(renderer, std::move(image));
    result.stoppedBy = stoppedBy;
    return result;
}

/// Depth in units of the scene's diagonal; other views are colours already.
Bitmap displayOfView(const RenderResult& result, const IntegratorInfo& info) {
    Bitmap display = result.image.picture();
    if (info.name == "depth" && result.sceneDiagonal > 0.0f)
        for (float& value : display.pixels) value /= result.sceneDiagonal;
    return display;
}

}  // namespace

RenderResult renderUntilDone(Device& device, const Scene& scene, const RenderSettings& settings, bool quiet) {
    std::optional<RenderResult> last;
    return renderOnce(device, scene, settings, quiet, last);
}

RenderResult renderDespiteLosses(ReplaceableDevice& device, const Scene& scene, RenderSettings& settings, bool quiet) {
    std::optional<RenderResult> last;
    LossRecovery recovery;
    RenderResult result;
    try {
        result = renderThroughLosses(device, settings, recovery, [&](Device& here, const RenderSettings& now) {
            return renderOnce(here, scene, now, quiet, last);
        });
    } catch (const DeviceLost& loss) {
        if (!last) throw;
        logError(std::string(loss.what()) + "; the picture has the samples of the last look at its noise");
        result = std::move(*last);
        result.stoppedBy = kStoppedByLoss;
    }
    result.deviceLosses = recovery.losses() + (result.stoppedBy == kStoppedByLoss ? 1 : 0);
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
        writeExr(path, filmLayers(result.image), metadata);
    } else if (path.extension() == ".hdr") {
        writeHdr(path, result.image.picture(), metadata);
    } else {
        const IntegratorInfo& info = findIntegrator(settings.integrator);
        const Bitmap display = info.isView ? displayOfView(result, info)
                                           : tonemapImage(result.image.picture(), settings.exposure, settings.tonemap);
        writePng(path, display, metadata);
    }
}

}  // namespace raylab
