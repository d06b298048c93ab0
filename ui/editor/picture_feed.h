#pragma once

#include <memory>

#include "engine/core/stopwatch.h"
#include "engine/render/renderer.h"
#include "ui/editor/render_request.h"

namespace raylab {

/// Makes pictures of films as these grow, so often that making them takes a small share of the time. What has no sample
/// yet shows the film before.
class PictureFeed {
public:
    /// What is shown now stands behind the next film where that has nothing yet.
    void keepBackdrop();
    /// A film has just been started.
    void begin();
    /// Whether a picture is due: the first with a sample in every pixel, or some time after the last.
    bool isDue(const Renderer& renderer) const;
    /// The picture of the film as it is now, without hits. It is not denoised where `stop` says to leave off.
    std::shared_ptr<Picture> make(Renderer& renderer, const RenderSettings& settings,
                                  const std::function<bool()>& stop);
    /// All that belongs to the picture has been done; `seconds` is what it took.
    void finish(double seconds);

    /// Estimated relative error of the film; negative where it is not known yet.
    double noise() const { return noise_; }

private:
    Bitmap backdrop_;
    Bitmap lastMean_;
    double noise_ = -1.0;
    uint32_t madeSamples_ = 0;  ///< of the film's last picture
    uint64_t count_ = 0;
    double interval_ = 0.0;
    Stopwatch sinceLast_;
};

}  // namespace raylab
