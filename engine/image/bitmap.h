#pragma once

#include <cstddef>
#include <vector>

namespace raylab {

/// A linear, scene-referred float image: `channels` interleaved values a pixel, rows from top to bottom.
struct Bitmap {
    int width = 0;
    int height = 0;
    int channels = 3;
    std::vector<float> pixels;  ///< width * height * channels values

    Bitmap() = default;
    Bitmap(int width_, int height_, int channels_)
        : width(width_), height(height_), channels(channels_),
          pixels(static_cast<size_t>(width_) * static_cast<size_t>(height_) * static_cast<size_t>(channels_)) {}

    size_t pixelCount() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    float* at(int x, int y) { return pixels.data() + (static_cast<size_t>(y) * width + x) * channels; }
    const float* at(int x, int y) const { return pixels.data() + (static_cast<size_t>(y) * width + x) * channels; }
};

}  // namespace raylab
