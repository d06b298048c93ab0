#include "ui/editor/picture_feed.h"

#include <algorithm>
#include <utility>

#include "ui/editor/picture.h"

namespace raylab {
namespace {

/// Pictures are made at most so often, and take no more than this share of the time.
constexpr double kInterval = 0.12;
constexpr double kShare = 0.12;

}  // namespace

void PictureFeed::keepBackdrop() {
    if (lastMean_.pixelCount() > 0) backdrop_ = lastMean_;
}

void PictureFeed::begin() {
    noise_ = -1.0;
    madeSamples_ = 0;
}

bool PictureFeed::isDue(const Renderer& renderer) const {
    const bool isFirstPass = renderer.completeSamples() > 0 && madeSamples_ == 0;
    return isFirstPass || sinceLast_.seconds() >= interval_;
}

std::shared_ptr<Picture> PictureFeed::make(Renderer& renderer, const RenderSettings& settings,
                                           const std::function<bool()>& stop) {
    const auto film = std::make_shared<const FilmImage>(renderer.develop(stop));
    if (renderer.completeSamples() > 1) noise_ = film->estimatedRelativeError;
    auto picture = std::make_shared<Picture>(developPicture(*film, backdrop_, settings, renderer.sceneDiagonal()));
    picture->film = film;
    picture->seconds = renderer.times().render + renderer.times().denoiseDevice;
    picture->camera = renderer.prepared().camera;
    picture->samples = renderer.completeSamples();
    picture->number = ++count_;
    madeSamples_ = picture->samples;
    if (picture->samples > 0) lastMean_ = film->picture();
    return picture;
}

void PictureFeed::finish(double seconds) {
    interval_ = std::max(kInterval, seconds / kShare);
    sinceLast_.restart();
}

}  // namespace raylab
