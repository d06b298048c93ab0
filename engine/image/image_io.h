#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/image/bitmap.h"

namespace raylab {

/// Keys and values in UTF-8, such as {"seed", "7"}: how an image was made travels inside it.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// A named part of an EXR file: "" is the main RGB(A), "variance" the channels variance.R, variance.G, ...; a layer of
/// one channel ("samples") is a channel of that name.
struct Layer {
    std::string name;
    Bitmap bitmap;
};

enum class Alpha { drop, keep };

/// PNG, JPEG, BMP, TGA (8 or 16 bits, decoded from sRGB; alpha is linear), Radiance HDR or OpenEXR (main layer, its
/// data window), known by content; only TGA needs its file name extension. The result is linear with 3 channels, or 4
/// where alpha is kept and the file has one; grey becomes RGB. EXR colours are premultiplied by alpha, the others' are
/// not. Throws Error: no such file, a folder, unknown format, damaged or cut short, more than 2^27 pixels.
Bitmap readImage(const std::filesystem::path& path, Alpha alpha = Alpha::drop);

/// All channels of all parts of an EXR file, HALF, FLOAT or UINT, grouped into layers, main layer first. Within a layer
/// R, G, B, A come in this order. In a multi-part file, a layer whose name is taken is named "part" or "part.layer".
/// `metadata` gets the string attributes "raylab.*" without that prefix, sorted by key. Throws Error as readImage does,
/// and for deep or chroma-subsampled images.
std::vector<Layer> readExrLayers(const std::filesystem::path& path, Metadata* metadata = nullptr);

/// 8-bit sRGB with 1, 3 or 4 channels from linear values in [0,1] (after tonemapping): clamped, rounded, NaN becomes 0.
/// Metadata become tEXt chunks, or iTXt where Latin-1 cannot hold them (PNG specification, 2nd edition,
/// section 11.3.4). Throws Error where the file cannot be written, the bitmap is empty, or a key is not a PNG keyword
/// (1 to 79 characters).
void writePng(const std::filesystem::path& path, const Bitmap& displayReferred, const Metadata& metadata = {});

/// The tEXt and the uncompressed iTXt chunks in file order, in UTF-8. Throws Error where it is no PNG or damaged.
std::vector<std::pair<std::string, std::string>> readPngText(const std::filesystem::path& path);

/// Radiance RGBE, run-length encoded (Ward, "Real Pixels", Graphics Gems II, 1991); 1, 3 or 4 channels, alpha is left
/// out. A channel is off by at most 2^-8 of the pixel's largest one. Below 0 and NaN become 0, infinity the largest
/// number that the format holds. Metadata become lines "# raylab.key=value" with backslash and line breaks escaped as
/// in C.
void writeHdr(const std::filesystem::path& path, const Bitmap& bitmap, const Metadata& metadata = {});

/// 32-bit float, ZIP, scan lines; layers of one size with 1, 3 or 4 channels; metadata as string attributes
/// "raylab.key". Throws Error where the file cannot be written, sizes differ, or layer names clash or contain a dot.
void writeExr(const std::filesystem::path& path, std::span<const Layer> layers, const Metadata& metadata = {});

// All writing is atomic: where it fails, Error is thrown and the old file stays as it was.

}  // namespace raylab
