#pragma once

#include <memory>

#include "engine/render/film.h"
#include "engine/render/integrators.h"
#include "engine/render/prepared_scene.h"

namespace raylab {

/// Seconds of wall time by phase; `device` is the device's own time for the rendering dispatches.
struct RenderTimes {
    double build = 0.0;
    double upload = 0.0;
    double compile = 0.0;
    double render = 0.0;
    double device = 0.0;
    double longestDispatch = 0.0;
};

/// Renders progressively: each step is one dispatch of about settings.sliceMs, so that nothing waits long for an answer.
class Renderer {
public:
    /// Builds, uploads and compiles. The scene is not needed afterwards. Throws Error where it does not fit the device.
    Renderer(Device& device, const Scene& scene, const RenderSettings& settings);

    /// One dispatch. False when all samples are done.
    bool step();

    /// Samples that every pixel has.
    uint32_t completeSamples() const { return passFirst_; }
    /// Samples done, over all samples asked for.
    double fractionDone() const;
    uint64_t pixelSamples() const { return pixelSamples_; }

    FilmImage snapshot() { return film_.read(device_); }
    const RenderTimes& times() const { return times_; }
    const PreparedScene& prepared() const { return prepared_; }
    float sceneDiagonal() const { return frame_.sceneDiagonal; }
    size_t filmBytes() const { return film_.memoryBytes(); }

private:
    double dispatch(uint32_t firstBlock, uint32_t blockCount, uint32_t firstSample, uint32_t sampleCount);
    uint32_t chooseBlockCount() const;
    void chooseSampleCount();

    Device& device_;
    RenderSettings settings_;
    PreparedScene prepared_;
    shared::FrameParams frame_{};
    Film film_;
    Buffer frameBuffer_;
    KernelLayout layout_;
    Kernel kernel_;
    uint32_t blockCount_ = 0;   ///< of the image
    uint32_t nextBlock_ = 0;    ///< of the pass that is under way
    uint32_t passFirst_ = 0;    ///< first sample of it
    uint32_t passSamples_ = 1;  ///< samples of it
    uint32_t lastBlockCount_ = 0;
    double secondsPerBlockSample_ = 0.0;
    double passSeconds_ = 0.0;
    uint64_t pixelSamples_ = 0;
    RenderTimes times_;
};

}  // namespace raylab
