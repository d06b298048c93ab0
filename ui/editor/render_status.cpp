#include "ui/editor/render_status.h"

#include <algorithm>

namespace raylab {

void describeKernel(const Renderer& renderer, RenderStatus& status) {
    const RenderTimes& times = renderer.times();
    const PreparedScene& prepared = renderer.prepared();
    status.buildSeconds = times.build;
    status.uploadSeconds = times.upload;
    status.compileSeconds = times.compile;
    status.needs = prepared.needs.needs;
    status.kernelNeeds = prepared.kernelNeeds;
    status.tracer = prepared.tracer->info().name;
    status.sceneBytes = prepared.gpu->memoryBytes();
    status.traceBytes = prepared.tracer->memoryBytes();
}

void describeFilm(const Renderer& renderer, const RenderSettings& wanted, const FilmImage* film, RenderStatus& status) {
    const RenderTimes& times = renderer.times();
    const double done = renderer.fractionDone();
    status.samples = renderer.completeSamples();
    status.samplesWanted = static_cast<uint32_t>(wanted.spp);
    status.seconds = times.render;
    status.secondsLeft = done > 0.0 ? times.render * (1.0 - done) / done : 0.0;
    if (wanted.timeLimit > 0.0)
        status.secondsLeft = std::min(status.secondsLeft, std::max(wanted.timeLimit - times.render, 0.0));
    status.longestDispatch = times.longestDispatch;
    status.filmBytes = renderer.filmBytes() + renderer.queueBytes();
    if (film == nullptr) return;
    status.width = static_cast<uint32_t>(film->mean.width);
    status.height = static_cast<uint32_t>(film->mean.height);
    if (times.render > 0.0) status.raysPerSecond = static_cast<double>(film->rays) / times.render;
}

std::string reasonToStop(const Renderer& renderer, const RenderSettings& wanted, double noise) {
    if (renderer.completeSamples() == 0) return "";
    if (wanted.timeLimit > 0.0 && renderer.times().render >= wanted.timeLimit) return "time limit";
    if (wanted.targetError > 0.0 && noise >= 0.0 && noise <= wanted.targetError) return "target error";
    return "";
}

}  // namespace raylab
