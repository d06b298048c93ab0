#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/gpu/pipeline.h"
#include "engine/render/film.h"

namespace raylab {

/// What a rendering may do with its picture at the end; the first one is kNoDenoiser.
std::vector<std::string> denoiserNames();

/// Means over a pixel of what the first hits are, of the views of those names; (0, 0, 0) and 0 where nothing is hit.
struct DenoiseGuides {
    Bitmap albedo;  ///< RGB
    Bitmap normal;  ///< 0.5 + 0.5 n
    Bitmap depth;   ///< scene units, in the first of three channels
};

/// Takes noise out of a picture by an edge-avoiding a-trous wavelet over its light, which is divided by the surfaces'
/// colour meanwhile, within the bounds that the variance of the pixels sets: shaders/film/denoise_main.glsl. What is
/// seen in mirrors and through glass has no guides. A pixel without samples gets the light of its surface around. Biased, and
/// less so with every sample.
class Denoiser {
public:
    /// `mostPixels`: of a strip of rows that is filtered at a time; also bounded by the device's buffers.
    explicit Denoiser(Device& device, size_t mostPixels = size_t{1} << 23);

    /// RGB. `stop` is asked between dispatches: nothing where it says so. Throws Error where not even a strip as high as
    /// the filter reaches fits the device.
    std::optional<Bitmap> filter(const FilmImage& film, const DenoiseGuides& guides, const std::function<bool()>& stop);
    /// The device's time for the last picture.
    double deviceSeconds() const { return deviceSeconds_; }

private:
    bool filterStrip(std::span<const glm::vec4> guides, uint32_t width, bool estimates,
                     std::span<glm::vec4> light, const std::function<bool()>& stop);

    Device& device_;
    size_t mostPixels_;
    KernelLayout layout_;
    Kernel kernel_;
    double deviceSeconds_ = 0.0;
};

}  // namespace raylab
