#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/image/bitmap.h"

namespace raylab {

/// An 8-bit RGBA image as stored in its file: no transfer function is applied. Rows from top to bottom.
struct Image8 {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint32_t> texels;  ///< R in the lowest byte
    bool hasAlpha = false;         ///< some texel is not opaque
};

/// Decodes PNG, JPEG, BMP or TGA of 8 or 16 bits a channel (16 is cut to 8); grey becomes RGB. A miss (another format,
/// damaged, cut short, absurd size) is nullopt, and `whyNot` says why in words that follow a file name.
std::optional<Image8> decodeImage8(std::span<const std::byte> encoded, std::string& whyNot);

/// A PNG file from which decodeImage8 reads the same texels; without an alpha channel where all are opaque.
/// `texels` holds width * height values, R in the lowest byte.
std::vector<std::byte> encodePng8(std::span<const uint32_t> texels, uint32_t width, uint32_t height);

/// What writePng() writes: linear light of [0,1] in 3 channels, or 1, encoded as sRGB.
Image8 encodeSrgb8(const Bitmap& displayReferred);

}  // namespace raylab
