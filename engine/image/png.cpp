#include <algorithm>
#include <optional>
#include <string_view>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/formats.h"
#include "engine/image/image_io.h"
#include "engine/image/png_chunks.h"
#include "engine/image/srgb.h"

namespace raylab {
namespace fs = std::filesystem;
namespace {

constexpr size_t kMaxKeywordBytes = 79;
constexpr size_t kHeaderBytes = kPngSignatureBytes + kPngChunkOverhead + 13;  ///< signature and IHDR
constexpr std::string_view kPerceptualIntent("\0", 1);

/// A miss where a character is beyond U+00FF.
std::optional<std::string> latin1FromUtf8(std::string_view utf8) {
    std::string latin1;
    for (size_t i = 0; i < utf8.size(); ++i) {
        const auto byte = static_cast<unsigned char>(utf8[i]);
        if (byte < 0x80) {
            latin1.push_back(utf8[i]);
        } else if ((byte == 0xc2 || byte == 0xc3) && i + 1 < utf8.size()) {
            const auto next = static_cast<unsigned char>(utf8[++i]);
            latin1.push_back(static_cast<char>((byte & 3u) << 6 | (next & 0x3fu)));
        } else {
            return std::nullopt;
        }
    }
    return latin1;
}

std::string utf8FromLatin1(std::string_view latin1) {
    std::string utf8;
    for (const char character : latin1) {
        const auto byte = static_cast<unsigned char>(character);
        if (byte < 0x80) {
            utf8.push_back(character);
        } else {
            utf8.push_back(static_cast<char>(0xc0u | byte >> 6));
            utf8.push_back(static_cast<char>(0x80u | (byte & 0x3fu)));
        }
    }
    return utf8;
}

bool isKeyword(std::string_view latin1) {
    const auto printable = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return (byte >= 32 && byte <= 126) || byte >= 161;
    };
    return !latin1.empty() && latin1.size() <= kMaxKeywordBytes && std::ranges::all_of(latin1, printable) &&
           !latin1.starts_with(' ') && !latin1.ends_with(' ') && latin1.find("  ") == std::string_view::npos;
}

void appendMetadata(std::vector<std::byte>& file, const Metadata& metadata, const fs::path& path) {
    for (const auto& [key, value] : metadata) {
        const std::optional<std::string> keyword = latin1FromUtf8(key);
        if (!keyword || !isKeyword(*keyword) || value.find('\0') != std::string::npos)
            throw Error(path.string() + ": PNG cannot hold the text '" + key +
                            "'; a key has 1 to 79 printable Latin-1 characters, a value no zero byte",
                        ExitCode::internalError);
        std::string data = *keyword + '\0';
        const std::optional<std::string> latin1 = latin1FromUtf8(value);
        if (!latin1) data.append(4, '\0');  // of iTXt: uncompressed, method 0, no language, no translated keyword
        data += latin1.value_or(value);
        appendPngChunk(file, latin1 ? "tEXt" : "iTXt", data);
    }
}

std::optional<std::pair<std::string, std::string>> parseText(const PngChunk& chunk) {
    const std::string_view data(reinterpret_cast<const char*>(chunk.data.data()), chunk.data.size());
    const size_t keyEnd = data.find('\0');
    if (keyEnd == std::string_view::npos) return std::nullopt;
    const std::string key = utf8FromLatin1(data.substr(0, keyEnd));
    if (chunk.type == "tEXt") return std::pair(key, utf8FromLatin1(data.substr(keyEnd + 1)));

    const bool uncompressed = chunk.type == "iTXt" && data.size() > keyEnd + 2 && data[keyEnd + 1] == '\0';
    if (!uncompressed) return std::nullopt;
    const size_t languageEnd = data.find('\0', keyEnd + 3);
    if (languageEnd == std::string_view::npos) return std::nullopt;
    const size_t translationEnd = data.find('\0', languageEnd + 1);
    if (translationEnd == std::string_view::npos) return std::nullopt;
    return std::pair(key, std::string(data.substr(translationEnd + 1)));
}

std::vector<uint8_t> encodeSamples(const Bitmap& bitmap) {
    std::vector<uint8_t> samples(bitmap.pixels.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        const bool isAlpha = bitmap.channels == 4 && i % 4 == 3;
        samples[i] = isAlpha ? quantize8(bitmap.pixels[i]) : linearToSrgb8(bitmap.pixels[i]);
    }
    return samples;
}

}  // namespace

void writePng(const fs::path& path, const Bitmap& displayReferred, const Metadata& metadata) {
    formats::requireWhole(displayReferred, path);
    const std::vector<std::byte> encoded = formats::encodePng8(encodeSamples(displayReferred), displayReferred.width,
                                                               displayReferred.height, displayReferred.channels);
    const auto afterHeader = encoded.begin() + kHeaderBytes;
    std::vector<std::byte> file(encoded.begin(), afterHeader);
    appendPngChunk(file, "sRGB", kPerceptualIntent);
    appendMetadata(file, metadata, path);
    file.insert(file.end(), afterHeader, encoded.end());
    writeFileAtomically(path, file);
}

std::vector<std::pair<std::string, std::string>> readPngText(const fs::path& path) {
    const std::vector<std::byte> bytes = readFile(path);
    if (!isPng(bytes)) throw Error(path.string() + ": is no PNG image; only PNG is searched for text");
    if (const std::optional<std::string> damage = pngDamage(bytes))
        throw Error(path.string() + ": " + *damage + "; export the image again");
    std::vector<std::pair<std::string, std::string>> texts;
    for (const PngChunk& chunk : readPngChunks(bytes))
        if (chunk.intact)
            if (auto text = parseText(chunk)) texts.push_back(std::move(*text));
    return texts;
}

}  // namespace raylab
