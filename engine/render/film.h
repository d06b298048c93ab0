#pragma once

#include <cstdint>
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/image/image_io.h"
#include "shaders/shared/frame.h"

namespace raylab {

/// Added to the squared mean where an error is relative: that of pixels darker than 0.1 counts as absolute, as in
/// measure/image_error.h.
constexpr double kRelativeErrorFloor = 1e-2;

/// The film as the host sees it: estimates in double precision.
struct FilmImage {
    Bitmap mean;      ///< RGB radiance
    Bitmap denoised;  ///< RGB radiance; of no size where nothing denoises
    Bitmap variance;  ///< RGB, of one sample; divided by `samples` it is the variance of the mean
    Bitmap samples;   ///< one channel: samples a pixel
    uint64_t rays = 0;                   ///< traced in all
    uint64_t nonFinitePixels = 0;        ///< pixels in which a sample was infinite or NaN (and was left out)
    double clampedEnergy = 0;            ///< luminance that clamping took away, over what there would be without it
    double estimatedRelativeError = 0;   ///< root of the mean relative variance of the pixels' luminance: an estimate of sqrt(relMSE)

    /// What is to be looked at.
    const Bitmap& picture() const { return denoised.pixels.empty() ? mean : denoised; }
};

/// Sums of samples on the device, in bands of rows, each within the device's storage buffer range.
class Film {
public:
    Film(Device& device, uint32_t width, uint32_t height);

    VkBuffer buffer() const { return buffer_.get(); }
    uint32_t rowsPerBand() const { return rowsPerBand_; }  ///< a multiple of shared::kTileSize
    size_t bandBytes() const { return bandBytes_; }        ///< range of one band's binding
    size_t memoryBytes() const { return buffer_.sizeBytes(); }

    void clear(Device& device);
    FilmImage read(Device& device) const;

private:
    Buffer buffer_;
    uint32_t width_, height_, rowsPerBand_;
    size_t bandBytes_;
};

/// Layers of an EXR file: "" the picture, "variance" and "samples" of its pixels. A denoised picture has no variance that
/// is known: "raw", "raw-variance" and "samples" are those of what it was made of.
std::vector<Layer> filmLayers(const FilmImage& film);

/// Means, variances and the error of a film's pixels, row by row.
FilmImage developFilm(const std::vector<shared::FilmPixel>& pixels, uint32_t width, uint32_t height);

}  // namespace raylab
