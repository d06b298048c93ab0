#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/error.h"
#include "engine/image/bitmap.h"
#include "tests/support/paths.h"
#include "tests/support/scratch_folder.h"

/// Image files built by hand, byte after byte, so that readers are not tested with our own writers alone.
namespace raylab::imagetest {
namespace fs = std::filesystem;

using support::ScratchFolder;

inline std::string fileBytes(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline fs::path putFile(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

inline std::span<const std::byte> asBytes(const std::string& text) {
    return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

/// The message of the Error that `action` throws; empty where it throws none.
template <typename Action>
std::string errorOf(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

inline Bitmap randomBitmap(int width, int height, int channels, uint32_t seed, float highest = 1.0f) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> uniform(0.0f, highest);
    Bitmap bitmap(width, height, channels);
    for (float& value : bitmap.pixels) value = uniform(generator);
    return bitmap;
}

inline std::string bigEndian32(uint32_t value) {
    return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
            static_cast<char>(value)};
}

/// The CRC of PNG by long division, bit after bit.
inline uint32_t bitwiseCrc(const std::string& text) {
    uint32_t crc = 0xffffffffu;
    for (const char c : text) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1u) ? 0xedb88320u : 0u);
    }
    return ~crc;
}

inline std::string pngChunk(const std::string& type, const std::string& data) {
    return bigEndian32(static_cast<uint32_t>(data.size())) + type + data + bigEndian32(bitwiseCrc(type + data));
}

/// zlib with one stored block (RFC 1950, 1951); at most 65535 bytes.
inline std::string storedZlib(const std::string& data) {
    uint32_t a = 1, b = 0;
    for (const char c : data) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<uint32_t>(data.size());
    const std::string length = {static_cast<char>(size), static_cast<char>(size >> 8), static_cast<char>(~size),
                                static_cast<char>(~size >> 8)};
    return std::string("\x78\x01\x01", 3) + length + data + bigEndian32(b << 16 | a);
}

/// `rows` as PNG has them: each with its filter byte in front. colorType: 0 grey, 2 RGB, 4 grey and alpha, 6 RGBA.
inline std::string handMadePng(uint32_t width, uint32_t height, int bitDepth, int colorType, const std::string& rows) {
    const std::string header = bigEndian32(width) + bigEndian32(height) + static_cast<char>(bitDepth) +
                               static_cast<char>(colorType) + std::string(3, '\0');
    return "\x89PNG\r\n\x1a\n" + pngChunk("IHDR", header) + pngChunk("IDAT", storedZlib(rows)) + pngChunk("IEND", "");
}

template <typename T>
std::string littleEndian(T value) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    return bytes;
}

struct ExrChannel {
    std::string name;
    int type;                       ///< 0 UINT, 1 HALF, 2 FLOAT
    std::vector<std::string> rows;  ///< the samples of each row as stored
    int sampling = 1;
};

struct ExrPart {
    std::string name;  ///< of multi-part files only
    int minX, minY, maxX, maxY;
    std::vector<ExrChannel> channels;  ///< sorted by name, as the format demands
};

inline std::string exrAttribute(const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + littleEndian(static_cast<int32_t>(value.size())) + value;
}

inline std::string exrHeader(const ExrPart& part) {
    std::string channels;
    for (const ExrChannel& channel : part.channels)
        channels += channel.name + '\0' + littleEndian<int32_t>(channel.type) + std::string(4, '\0') +
                    littleEndian<int32_t>(channel.sampling) + littleEndian<int32_t>(channel.sampling);
    channels += '\0';
    const std::string window = littleEndian<int32_t>(part.minX) + littleEndian<int32_t>(part.minY) +
                               littleEndian<int32_t>(part.maxX) + littleEndian<int32_t>(part.maxY);
    std::string header = exrAttribute("channels", "chlist", channels) +
                         exrAttribute("compression", "compression", std::string(1, '\0')) +
                         exrAttribute("dataWindow", "box2i", window) + exrAttribute("displayWindow", "box2i", window) +
                         exrAttribute("lineOrder", "lineOrder", std::string(1, '\0')) +
                         exrAttribute("pixelAspectRatio", "float", littleEndian(1.0f)) +
                         exrAttribute("screenWindowCenter", "v2f", littleEndian(0.0f) + littleEndian(0.0f)) +
                         exrAttribute("screenWindowWidth", "float", littleEndian(1.0f));
    if (!part.name.empty())
        header += exrAttribute("chunkCount", "int", littleEndian<int32_t>(part.maxY - part.minY + 1)) +
                  exrAttribute("name", "string", part.name) + exrAttribute("type", "string", "scanlineimage");
    return header + '\0';
}

/// An uncompressed scan line file ("OpenEXR File Layout", openexr.com); with several parts a multi-part file.
inline std::string handMadeExr(const std::vector<ExrPart>& parts) {
    const bool multiPart = parts.size() > 1;
    std::string file = littleEndian<uint32_t>(20000630) + littleEndian<uint32_t>(multiPart ? 0x1002 : 2);
    size_t lines = 0;
    for (const ExrPart& part : parts) {
        file += exrHeader(part);
        lines += static_cast<size_t>(part.maxY - part.minY + 1);
    }
    if (multiPart) file += '\0';
    uint64_t offset = file.size() + lines * sizeof(uint64_t);
    std::string table, chunks;
    for (size_t p = 0; p < parts.size(); ++p)
        for (int y = parts[p].minY; y <= parts[p].maxY; ++y) {
            std::string data;
            for (const ExrChannel& channel : parts[p].channels)
                data += channel.rows[static_cast<size_t>(y - parts[p].minY)];
            const std::string chunk = (multiPart ? littleEndian(static_cast<int32_t>(p)) : "") +
                                      littleEndian<int32_t>(y) + littleEndian(static_cast<int32_t>(data.size())) + data;
            table += littleEndian(offset);
            chunks += chunk;
            offset += chunk.size();
        }
    return file + table + chunks;
}

inline fs::path scenes() { return support::sharedScenes(); }

}  // namespace raylab::imagetest
