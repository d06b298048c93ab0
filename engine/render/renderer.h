#pragma once

#include <memory>

#include "engine/render/film.h"
#include "engine/render/integrators.h"
#include "engine/render/picture_denoiser.h"
#include "engine/render/prepared_scene.h"
#include "engine/render/wavefront.h"

namespace raylab {

/// Seconds of wall time by phase; `device` is the device's own time for the rendering dispatches.
struct RenderTimes {
    double build = 0.0;
    double upload = 0.0;
    double compile = 0.0;
    double render = 0.0;
    double device = 0.0;
    double denoise = 0.0;        ///< wall time of the last develop(), beyond reading the film
    double denoiseDevice = 0.0;  ///< the device's own for that picture, guides included that were kept from the one before
    double longestDispatch = 0.0;
};

/// A pixel, that a rendering has to have: an adaptive one looks first where the noise is.
uint32_t leastSamples(const RenderSettings& settings);

/// Renders progressively: each step is one dispatch of about settings.sliceMs, so that nothing waits long for an answer.
/// Adaptive: after a pilot, whose samples are thrown away, every block of pixels gets samples at a rate of its own
/// (engine/render/adaptive.h).
class Renderer {
public:
    /// Builds, uploads and compiles. The scene is not needed afterwards. Throws Error where it does not fit the device.
    Renderer(Device& device, const Scene& scene, const RenderSettings& settings);
    /// Over a scene that is prepared already, by the same settings; others may use it between two calls.
    Renderer(Device& device, std::shared_ptr<PreparedScene> prepared, const RenderSettings& settings);

    /// Starts over with another camera, size, seed or method: with all settings that prepareScene() does not read. The
    /// kernel is made anew only where the settings ask for another.
    void restart(const RenderSettings& settings, const Camera& camera);
    /// Starts over with a scene that has changed: updateScene().
    void update(const Scene& scene, const SceneChange& change);
    /// Starts over with a scene whose surfaces or lights have changed: updateShading().
    void updateShading(const Scene& scene);
    /// Goes on to another number of samples. They are those that a rendering of so many has from the start unless the
    /// sampler is stratified.
    void setSampleGoal(int64_t spp) { settings_.spp = spp; }
    /// Samples of a pass over the image at most where lanes go on from one sample to the next: few for a picture that is
    /// looked at while it grows, whose pixels then have nearly as many.
    void limitPass(uint32_t samples) { mostOfPass_ = samples; }
    /// Of the pictures from now on: of denoiserNames().
    void setDenoiser(const std::string& name) { settings_.denoise = name; }

    /// One dispatch. False when all samples are done.
    bool step();

    /// Begins anew with an empty film, as if made with this seed and number of samples; build, upload and compile keep
    /// their times.
    void restart(uint32_t seed, uint32_t spp);

    /// Samples that every pixel has.
    uint32_t completeSamples() const { return static_cast<uint32_t>(leastRate_ * (passFirst_ - firstKept_)); }
    /// Samples done, over all samples asked for.
    double fractionDone() const;
    /// In all pixels, the pilot's too.
    uint64_t pixelSamples() const { return static_cast<uint64_t>(pixelSamples_); }

    FilmImage snapshot() { return film_.read(device_); }
    /// Whether develop() takes out noise: the settings ask for it and the integrator shows no view.
    bool denoises() const;
    /// The same, and denoised where the settings ask for it and the integrator shows no view; not so where `stop`, asked
    /// between dispatches, says to leave off.
    FilmImage develop(const std::function<bool()>& stop = [] { return false; });
    const RenderTimes& times() const { return times_; }
    const PreparedScene& prepared() const { return *prepared_; }
    float sceneDiagonal() const { return frame_.sceneDiagonal; }
    size_t filmBytes() const { return film_.memoryBytes(); }
    /// States of paths and their queues; 0 where one kernel follows each path to its end.
    size_t queueBytes() const { return wavefront_ ? wavefront_->memoryBytes() : 0; }

private:
    void begin();
    void chooseSchedule();
    void makeKernel();
    void startOver(const shared::FrameParams& frame);
    double dispatch(uint32_t firstBlock, uint32_t blockCount, uint32_t firstSample, uint32_t sampleCount);
    uint32_t chooseBlockCount() const;
    uint32_t pathsPerLane(uint32_t sampleCount) const;
    bool regenerates() const;
    uint32_t mostBlocks() const;
    void chooseSampleCount();
    void uploadFrame();
    void bindRates(std::span<const float> rates);
    void finishPilot();

    Device& device_;
    RenderSettings settings_;
    std::shared_ptr<PreparedScene> prepared_;
    shared::FrameParams frame_{};
    Film film_;
    Buffer frameBuffer_;
    TexelBuffer rates_;  ///< of blocks; none where it is not adaptive
    KernelLayout layout_;
    Kernel kernel_;  ///< none under a wavefront, which has its own
    std::unique_ptr<Wavefront> wavefront_;
    std::vector<SpecConstant> kernelConstants_;  ///< that the kernels were made with; empty: they are still to be made
    std::unique_ptr<PictureDenoiser> denoiser_;  ///< made when it is first asked for
    uint32_t blockCount_ = 0;   ///< of the image
    uint32_t nextBlock_ = 0;    ///< of the pass that is under way
    uint32_t passFirst_ = 0;    ///< first sample of it
    uint32_t pilotSamples_ = 0; ///< that go into finding the rates
    uint32_t firstKept_ = 0;    ///< sample that the film begins with
    double leastRate_ = 1.0, meanRate_ = 1.0, mostRate_ = 1.0;
    uint32_t passSamples_ = 1;  ///< samples of it
    uint32_t mostOfPass_ = 16;
    uint32_t lastBlockCount_ = 0;
    double secondsPerBlockSample_ = 0.0;
    double passSeconds_ = 0.0;
    double pixelSamples_ = 0.0;
    RenderTimes times_;
};

}  // namespace raylab
