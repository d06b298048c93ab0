#pragma once

#include <memory>
#include <vector>

#include "engine/render/denoise.h"
#include "engine/render/prepared_scene.h"

namespace raylab {

class Renderer;

/// The denoiser of a rendering, with the views of the first hits that guide it.
class PictureDenoiser {
public:
    explicit PictureDenoiser(Device& device);
    ~PictureDenoiser();

    /// The film's picture without noise, by `settings`; guides are rendered where forgetGuides() was called since the
    /// last time. Nothing where `stop`, asked between dispatches, says so.
    std::optional<Bitmap> filter(const FilmImage& film, const std::shared_ptr<PreparedScene>& prepared,
                                 const RenderSettings& settings, const std::function<bool()>& stop);
    /// Another camera, size or scene.
    void forgetGuides() { hasGuides_ = false; }
    /// The device's time for guides and filter of the last picture, also where the guides were kept from the one before.
    double deviceSeconds() const { return guideSeconds_ + denoiser_.deviceSeconds(); }

private:
    bool renderGuides(const std::shared_ptr<PreparedScene>& prepared, const RenderSettings& settings,
                      const std::function<bool()>& stop);

    Device& device_;
    Denoiser denoiser_;
    std::vector<std::unique_ptr<Renderer>> views_;  ///< of the guides, in their order
    DenoiseGuides guides_;
    bool hasGuides_ = false;
    double guideSeconds_ = 0.0;
};

}  // namespace raylab
