#include "engine/render/picture_denoiser.h"

#include <algorithm>
#include <array>

#include "engine/render/renderer.h"

namespace raylab {
namespace {

/// First hits of a pixel that its guides are means of: half as many as its samples, between these.
constexpr int64_t kLeastGuideSamples = 2, kMostGuideSamples = 8;
constexpr std::array kGuideViews = {"albedo", "normal", "depth"};

/// As the picture sees it, by the cheapest kernel.
RenderSettings viewSettings(RenderSettings settings, const char* view) {
    settings.integrator = view;
    settings.spp = std::clamp(settings.spp / 2, kLeastGuideSamples, kMostGuideSamples);
    settings.adaptive = false;
    settings.schedule = "mega";
    settings.clamp = 0.0;
    settings.denoise = kNoDenoiser;
    return settings;
}

}  // namespace

PictureDenoiser::PictureDenoiser(Device& device) : device_(device), denoiser_(device) {}

PictureDenoiser::~PictureDenoiser() = default;

bool PictureDenoiser::renderGuides(const std::shared_ptr<PreparedScene>& prepared, const RenderSettings& settings,
                                   const std::function<bool()>& stop) {
    std::array<Bitmap, kGuideViews.size()> views;
    for (size_t i = 0; i < kGuideViews.size(); ++i) {
        const RenderSettings own = viewSettings(settings, kGuideViews[i]);
        if (i == views_.size())
            views_.push_back(std::make_unique<Renderer>(device_, prepared, own));
        else
            views_[i]->restart(own, prepared->camera);
        while (views_[i]->step())
            if (stop()) return false;
        views[i] = views_[i]->snapshot().mean;
        deviceSeconds_ += views_[i]->times().device;
    }
    guides_ = {std::move(views[0]), std::move(views[1]), std::move(views[2])};
    hasGuides_ = true;
    return true;
}

std::optional<Bitmap> PictureDenoiser::filter(const FilmImage& film, const std::shared_ptr<PreparedScene>& prepared,
                                              const RenderSettings& settings, const std::function<bool()>& stop) {
    deviceSeconds_ = 0.0;
    if (!hasGuides_ && !renderGuides(prepared, settings, stop)) return std::nullopt;
    std::optional<Bitmap> picture = denoiser_.filter(film, guides_, stop);
    deviceSeconds_ += denoiser_.deviceSeconds();
    return picture;
}

}  // namespace raylab
