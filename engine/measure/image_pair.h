#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/bitmap.h"

namespace raylab {

/// What every comparison of two images shares: their shape, the pixels that count, and means over those.

/// 3 for RGB(A), where alpha is left out, and 1 for grey.
int colorChannels(const Bitmap& bitmap);

/// Throws Error where sizes differ, or one is grey and the other is not.
void requireSameShape(const Bitmap& image, const Bitmap& reference);

/// Which pixels count, row by row from the top: 0 is left out. Where a function takes none, or an empty one, all count.
using PixelMask = std::vector<uint8_t>;

/// The pixels of `picture` with a colour channel other than 0.
PixelMask maskOf(const Bitmap& picture);

/// Throws Error unless `mask` is empty or has as many entries as the bitmap has pixels.
void requireMaskFits(std::span<const uint8_t> mask, const Bitmap& bitmap);

/// No channel of the pixel is infinite or NaN.
bool isFinite(const float* pixel, int channels);

/// The pixels whose colour channels are infinite or NaN in either image.
PixelMask nonFinitePixels(const Bitmap& image, const Bitmap& reference);

/// In pixels; x and y count from the top left.
struct PixelRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// A part of a bitmap. Throws Error where the rectangle is empty or reaches beyond the bitmap.
Bitmap cropped(const Bitmap& bitmap, const PixelRect& rect);

/// Mean of a map of one channel over the pixels that count and have a number; NaN where there is none.
double meanOf(const Bitmap& map, std::span<const uint8_t> mask = {});

/// A map of one channel as a linear RGB picture for writePng: `lowest` and less black, over violet, red and orange to
/// `highest` and more white, lightness growing evenly. NaN is cyan and what the mask leaves out is grey; the scale
/// lacks both.
Bitmap heatPicture(const Bitmap& map, double lowest, double highest, std::span<const uint8_t> mask = {});

}  // namespace raylab
