#include "engine/render/picture_denoiser.h"

#include <algorithm>
#include <array>

#include "engine/render/renderer.h"

namespace raylab {
namespace {

/// First hits of a pixel that its guides are means of: half as many as its samples, between these.
constexpr int64_t kLeastGuideSamples = 2, kMostGuideSamples = 8;
/// Of larger pictures the views' films are not kept for the next one.
constexpr int64_t kKeptPixels = int64_t{1} << 21;
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

PictureDenoiser::PictureDenoiser(Device& device) : device_(device), denoiser_(device), views_(kGuideViews.size()) {}

PictureDenoiser::~PictureDenoiser() = default;

bool PictureDenoiser::renderGuides(const std::shared_ptr<PreparedScene>& prepared, const RenderSettings& settings,
                                   const std::function<bool()>& stop) {
    guideSeconds_ = 0.0;
    std::array<Bitmap, kGuideViews.size()> views;
    for (size_t i = 0; i < kGuideViews.size(); ++i) {
        const RenderSettings own = viewSettings(settings, kGuideViews[i]);
        std::unique_ptr<Renderer>& view = views_[i];
        if (view)
            view->restart(own, prepared->camera);
        else
            view = std::make_unique<Renderer>(device_, prepared, own);
        while (view->step())
            if (stop()) return false;
        views[i] = view->snapshot().mean;
        guideSeconds_ += view->times().device;
        if (settings.width * settings.height > kKeptPixels) view.reset();
    }
    guides_ = {std::move(views[0]), std::move(views[1]), std::move(views[2])};
    hasGuides_ = true;
    return true;
}

std::optional<Bitmap> PictureDenoiser::filter(const FilmImage& film, const std::shared_ptr<PreparedScene>& prepared,
                                              const RenderSettings& settings, const std::function<bool()>& stop) {
    if (!hasGuides_ && !renderGuides(prepared, settings, stop)) return std::nullopt;
    return denoiser_.filter(film, guides_, stop);
}

}  // namespace raylab
