#pragma once

#include "engine/image/bitmap.h"

namespace raylab {

/// Pixels on a side of the window that SSIM looks through.
constexpr int kSsimWindow = 11;

/// Structural similarity of each pixel's surroundings, -1 to 1, as a map of one channel: Wang, Bovik, Sheikh,
/// Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity", 2004, with its constants: a
/// Gaussian window of 11 x 11 pixels and sigma 1.5, K1 = 0.01, K2 = 0.03, L = 1. It is taken of values clamped to [0,1]
/// and sRGB-encoded, as PSNR is, of each channel by itself, and averaged over the channels: luma alone would be blind
/// to a wrong hue (for grey images the two agree). Only whole windows count: a border of 5 pixels is NaN. Pixels that
/// are not finite in either image are NaN too and black to their neighbours in both. Symmetric in its arguments.
/// Throws Error where sizes differ, or one is grey. The mean SSIM is meanOf() the map.
Bitmap ssimMap(const Bitmap& image, const Bitmap& reference);

}  // namespace raylab
