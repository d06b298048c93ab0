#include "engine/render/film.h"

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/core/luminance.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

/// No band is larger, so that a film works in the same way on every device.
constexpr size_t kLargestBand = size_t{64} << 20;

uint32_t chooseRowsPerBand(const Device& device, uint32_t width, uint32_t height) {
    const size_t range = std::min<size_t>(device.limits().maxStorageBufferRange, kLargestBand);
    const size_t rows = range / (sizeof(shared::FilmPixel) * width) / shared::kTileSize * shared::kTileSize;
    if (rows == 0) throw Error("--width " + std::to_string(width) + " is too wide for this device");
    const uint32_t whole = (height + shared::kTileSize - 1) / shared::kTileSize * shared::kTileSize;
    // Bands start at multiples of the alignment that dynamic offsets need: eight rows of 64-byte pixels are 512 bytes.
    return static_cast<uint32_t>(std::min<size_t>(rows, whole));
}

}  // namespace

Film::Film(Device& device, uint32_t width, uint32_t height)
    : width_(width), height_(height), rowsPerBand_(chooseRowsPerBand(device, width, height)),
      bandBytes_(size_t{rowsPerBand_} * width * sizeof(shared::FilmPixel)) {
    const size_t bands = (height + rowsPerBand_ - 1) / rowsPerBand_;
    buffer_ = Buffer(device, "film", bands * bandBytes_,
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                     BufferPlace::device);
    clear(device);
}

void Film::clear(Device& device) {
    device.run("clear film", [&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, buffer_.get(), 0, VK_WHOLE_SIZE, 0);
    });
}

FilmImage Film::read(Device& device) const {
    std::vector<shared::FilmPixel> pixels(size_t{width_} * height_);
    download(device, buffer_, std::as_writable_bytes(std::span(pixels)));
    return developFilm(pixels, width_, height_);
}

std::vector<Layer> filmLayers(const FilmImage& film) {
    if (film.denoised.pixels.empty())
        return {{"", film.mean}, {"variance", film.variance}, {"samples", film.samples}};
    return {{"", film.denoised}, {"raw", film.mean}, {"raw-variance", film.variance}, {"samples", film.samples}};
}

FilmImage developFilm(const std::vector<shared::FilmPixel>& pixels, uint32_t width, uint32_t height) {
    const auto w = static_cast<int>(width), h = static_cast<int>(height);
    FilmImage image{.mean = Bitmap(w, h, 3), .variance = Bitmap(w, h, 3), .samples = Bitmap(w, h, 1)};
    double squaredError = 0.0, kept = 0.0, clamped = 0.0;
    for (size_t i = 0; i < pixels.size(); ++i) {
        const shared::FilmPixel& p = pixels[i];
        const double n = p.count;
        double mean[3] = {}, error[3] = {};
        for (int c = 0; c < 3 && p.count > 0; ++c) {
            const double sum = static_cast<double>(p.sumHi[c]) + static_cast<double>(p.sumLo[c]);
            const double square = static_cast<double>(p.squareHi[c]) + static_cast<double>(p.squareLo[c]);
            mean[c] = sum / n;
            const double variance = p.count > 1 ? std::max(0.0, (square - sum * mean[c]) / (n - 1.0)) : 0.0;
            error[c] = std::sqrt(variance / n);
            image.mean.pixels[3 * i + c] = static_cast<float>(mean[c]);
            image.variance.pixels[3 * i + c] = static_cast<float>(variance);
        }
        kept += luminance(mean) * n;
        clamped += static_cast<double>(p.clamped);
        image.samples.pixels[i] = static_cast<float>(p.count);
        image.rays += p.rays;
        image.nonFinitePixels += p.nonFinite > 0 ? 1 : 0;
        squaredError += luminance(error) * luminance(error) / (luminance(mean) * luminance(mean) + kRelativeErrorFloor);
    }
    image.clampedEnergy = clamped > 0.0 ? clamped / (kept + clamped) : 0.0;
    image.estimatedRelativeError = std::sqrt(squaredError / static_cast<double>(pixels.size()));
    return image;
}

}  // namespace raylab
