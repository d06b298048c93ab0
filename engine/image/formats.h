#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/image/bitmap.h"
#include "engine/image/image_io.h"

/// What the files of engine/image share. Nothing outside this folder includes it.
namespace raylab::formats {

/// 16384 x 8192, the largest panorama in use. More is taken for damage; it also keeps stb's sizes within an int.
constexpr int64_t kMaxPixels = int64_t{1} << 27;

inline bool isSaneSize(int64_t width, int64_t height) {
    return width > 0 && height > 0 && width <= kMaxPixels && height <= kMaxPixels && width * height <= kMaxPixels;
}

/// Throws Error, naming the file, where isSaneSize() is false.
void requireSaneSize(int64_t width, int64_t height, const std::filesystem::path& path);

/// Throws Error unless the bitmap has a sane size, 1, 3 or 4 channels and as many values as that makes.
void requireWhole(const Bitmap& bitmap, const std::filesystem::path& path);

/// The decoders throw Error, naming `path`, where the bytes are damaged.
Bitmap decodeLdr(std::span<const std::byte> bytes, Alpha alpha, const std::filesystem::path& path);
Bitmap decodeHdr(std::span<const std::byte> bytes, const std::filesystem::path& path);
Bitmap decodeExr(std::span<const std::byte> bytes, Alpha alpha, const std::filesystem::path& path);

/// A PNG file of `samples` as they are; `channels` interleaved bytes a pixel.
std::vector<std::byte> encodePng8(std::span<const uint8_t> samples, int width, int height, int channels);

}  // namespace raylab::formats
