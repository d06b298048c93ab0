#include "engine/image/image_io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/formats.h"

namespace raylab {
namespace fs = std::filesystem;

namespace formats {

void requireSaneSize(int64_t width, int64_t height, const fs::path& path) {
    if (isSaneSize(width, height)) return;
    throw Error(path.string() + ": its size of " + std::to_string(width) + " x " + std::to_string(height) +
                " pixels is not between 1 and " + std::to_string(kMaxPixels) + " pixels; resize the image");
}

void requireWhole(const Bitmap& bitmap, const fs::path& path) {
    requireSaneSize(bitmap.width, bitmap.height, path);
    const bool knownChannels = bitmap.channels == 1 || bitmap.channels == 3 || bitmap.channels == 4;
    if (!knownChannels || bitmap.pixels.size() != bitmap.pixelCount() * static_cast<size_t>(bitmap.channels))
        throw Error(path.string() + ": cannot write " + std::to_string(bitmap.pixels.size()) + " values as " +
                        std::to_string(bitmap.width) + " x " + std::to_string(bitmap.height) + " pixels of " +
                        std::to_string(bitmap.channels) + " channels; 1, 3 or 4 channels can be written",
                    ExitCode::internalError);
}

}  // namespace formats

namespace {

enum class Format { unknown, ldr, hdr, exr };

Format formatOf(std::span<const std::byte> bytes, const fs::path& path) {
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<size_t>(bytes.size(), 16));
    if (head.starts_with("\x76\x2f\x31\x01")) return Format::exr;
    if (head.starts_with("#?RADIANCE") || head.starts_with("#?RGBE")) return Format::hdr;
    for (const std::string_view magic : {"\x89PNG\r\n\x1a\n", "\xff\xd8\xff", "BM"})
        if (head.starts_with(magic)) return Format::ldr;
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension == ".tga" ? Format::ldr : Format::unknown;
}

}  // namespace

Bitmap readImage(const fs::path& path, Alpha alpha) {
    const std::vector<std::byte> bytes = readFile(path);
    switch (formatOf(bytes, path)) {
        case Format::ldr:
            return formats::decodeLdr(bytes, alpha, path);
        case Format::hdr:
            return formats::decodeHdr(bytes, path);
        case Format::exr:
            return formats::decodeExr(bytes, alpha, path);
        case Format::unknown:
            break;
    }
    throw Error(path.string() + (bytes.empty() ? ": is empty" : ": is no image of a known format") +
                "; give a PNG, JPEG, BMP, TGA, HDR or EXR file");
}

}  // namespace raylab
