// The one place that compiles stb_image. Its HDR reader is left out: on a file that is cut short it never returns
// (2.27).
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_FAILURE_USERMSG
#include <stb_image.h>

#include <algorithm>
#include <memory>
#include <type_traits>

#include "engine/core/error.h"
#include "engine/image/formats.h"
#include "engine/image/image8.h"
#include "engine/image/png_chunks.h"
#include "engine/image/srgb.h"

namespace raylab {
namespace {

/// What stb reads from. It takes zeros for what a truncated file lacks, so we note each read past the end ourselves.
struct Source {
    std::span<const std::byte> bytes;
    size_t position = 0;
    const char* refillBuffer = nullptr;  ///< stb's own; it is the target of the first read
    bool pastEnd = false;
};

int readSource(void* user, char* data, int size) {
    auto& source = *static_cast<Source*>(user);
    const auto wanted = static_cast<size_t>(size);
    const size_t got = std::min(wanted, source.bytes.size() - source.position);
    std::ranges::copy(source.bytes.subspan(source.position, got), reinterpret_cast<std::byte*>(data));
    source.position += got;
    if (!source.refillBuffer) source.refillBuffer = data;
    // A refill comes when a byte is needed, and asks for more than that byte: only an empty one is a read past the end.
    if (got == 0 || (got < wanted && data != source.refillBuffer)) source.pastEnd = true;
    return static_cast<int>(got);
}

void skipSource(void* user, int count) {
    auto& source = *static_cast<Source*>(user);
    const auto target = static_cast<int64_t>(source.position) + count;
    source.position = static_cast<size_t>(std::clamp<int64_t>(target, 0, static_cast<int64_t>(source.bytes.size())));
}

int sourceAtEnd(void* user) {
    const auto& source = *static_cast<const Source*>(user);
    return source.position >= source.bytes.size() ? 1 : 0;
}

constexpr stbi_io_callbacks kCallbacks{readSource, skipSource, sourceAtEnd};

struct FreeSamples {
    void operator()(void* samples) const { stbi_image_free(samples); }
};

/// RGBA as stored in the file.
template <typename Sample>
struct Decoded {
    std::unique_ptr<Sample, FreeSamples> samples;
    int width = 0;
    int height = 0;
    int fileChannels = 0;

    size_t sampleCount() const { return static_cast<size_t>(width) * static_cast<size_t>(height) * 4; }
};

/// No LDR format packs more: deflate shrinks to 1/1032 at best, and a pixel of PNG has at least one bit.
constexpr int64_t kMaxPixelsPerByte = 8 * 1032;

constexpr size_t kMaxHuffmanCodes = 256;

/// A table with more codes than there are bytes (JPEG standard T.81, B.2.4.2) makes stb_image 2.27 write out of bounds.
bool hasOverfullHuffmanTable(std::span<const std::byte> jpeg) {
    const auto byteAt = [&](size_t offset) { return offset < jpeg.size() ? static_cast<size_t>(jpeg[offset]) : 0; };
    for (size_t i = 0; i + 1 < jpeg.size(); ++i) {
        if (byteAt(i) != 0xff || byteAt(i + 1) != 0xc4) continue;
        const size_t end = i + 2 + (byteAt(i + 2) << 8 | byteAt(i + 3));
        for (size_t table = i + 4; table < end;) {
            size_t codes = 0;
            for (size_t length = 1; length <= 16; ++length) codes += byteAt(table + length);
            if (codes > kMaxHuffmanCodes) return true;
            table += 17 + codes;
        }
    }
    return false;
}

/// Why stb_image must not see the file, or cannot read its header.
std::optional<std::string> headerDamage(std::span<const std::byte> bytes) {
    if (bytes.empty()) return "is empty";
    if (isPng(bytes))
        if (std::optional<std::string> damage = pngDamage(bytes)) return damage;
    if (bytes[0] == std::byte{0xff} && hasOverfullHuffmanTable(bytes))
        return "is damaged (its Huffman table is too long)";
    Source source{bytes};
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_callbacks(&kCallbacks, &source, &width, &height, &channels))
        return "is no PNG, JPEG, BMP or TGA image, or damaged (" + std::string(stbi_failure_reason()) + ")";
    const bool canHoldThat = int64_t{width} * height <= static_cast<int64_t>(bytes.size()) * kMaxPixelsPerByte;
    if (!formats::isSaneSize(width, height) || !canHoldThat)
        return "claims " + std::to_string(width) + " x " + std::to_string(height) + " pixels in " +
               std::to_string(bytes.size()) + " bytes";
    return std::nullopt;
}

template <typename Sample>
std::optional<Decoded<Sample>> decode(std::span<const std::byte> bytes, std::string& whyNot) {
    if (const std::optional<std::string> damage = headerDamage(bytes)) {
        whyNot = *damage;
        return std::nullopt;
    }
    Source source{bytes};
    Decoded<Sample> image;
    constexpr auto load = [] {
        if constexpr (std::is_same_v<Sample, stbi_us>)
            return stbi_load_16_from_callbacks;
        else
            return stbi_load_from_callbacks;
    }();
    image.samples.reset(load(&kCallbacks, &source, &image.width, &image.height, &image.fileChannels, 4));
    if (image.samples && !source.pastEnd) return image;
    whyNot = source.pastEnd ? "is cut short" : "is damaged (" + std::string(stbi_failure_reason()) + ")";
    return std::nullopt;
}

bool is16Bit(std::span<const std::byte> bytes) {
    Source source{bytes};
    return stbi_is_16_bit_from_callbacks(&kCallbacks, &source) != 0;
}

template <typename Sample>
Bitmap decodeToLinear(std::span<const std::byte> bytes, Alpha alpha, const std::filesystem::path& path) {
    std::string whyNot;
    const std::optional<Decoded<Sample>> image = decode<Sample>(bytes, whyNot);
    if (!image) throw Error(path.string() + ": " + whyNot + "; export the image again");

    constexpr size_t kLevels = size_t{1} << (8 * sizeof(Sample));
    constexpr float kScale = 1.0f / static_cast<float>(kLevels - 1);
    std::vector<float> linear(kLevels);
    for (size_t i = 0; i < kLevels; ++i) linear[i] = srgbToLinear(static_cast<float>(i) * kScale);

    const bool fileHasAlpha = image->fileChannels == 2 || image->fileChannels == 4;
    Bitmap bitmap(image->width, image->height, alpha == Alpha::keep && fileHasAlpha ? 4 : 3);
    float* out = bitmap.pixels.data();
    for (size_t i = 0; i < image->sampleCount(); i += 4) {
        const Sample* in = image->samples.get() + i;
        for (int c = 0; c < 3; ++c) *out++ = linear[in[c]];
        if (bitmap.channels == 4) *out++ = static_cast<float>(in[3]) * kScale;
    }
    return bitmap;
}

}  // namespace

std::optional<Image8> decodeImage8(std::span<const std::byte> encoded, std::string& whyNot) {
    const std::optional<Decoded<stbi_uc>> image = decode<stbi_uc>(encoded, whyNot);
    if (!image) return std::nullopt;
    Image8 result{static_cast<uint32_t>(image->width), static_cast<uint32_t>(image->height), {}, false};
    result.texels.reserve(image->sampleCount() / 4);
    for (size_t i = 0; i < image->sampleCount(); i += 4) {
        const stbi_uc* in = image->samples.get() + i;
        result.texels.push_back(uint32_t{in[0]} | uint32_t{in[1]} << 8 | uint32_t{in[2]} << 16 | uint32_t{in[3]} << 24);
        result.hasAlpha |= in[3] != 255;
    }
    return result;
}

Bitmap formats::decodeLdr(std::span<const std::byte> bytes, Alpha alpha, const std::filesystem::path& path) {
    return is16Bit(bytes) ? decodeToLinear<stbi_us>(bytes, alpha, path) : decodeToLinear<stbi_uc>(bytes, alpha, path);
}

}  // namespace raylab
