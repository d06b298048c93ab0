#include "engine/image/png_chunks.h"

#include <array>

namespace raylab {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", kPngSignatureBytes);

/// CRC-32 of ISO 3309, bit-reversed polynomial (PNG specification, annex D).
constexpr std::array<uint32_t, 256> makeCrcTable() {
    std::array<uint32_t, 256> table{};
    for (uint32_t i = 0; i < 256; ++i) {
        uint32_t crc = i;
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1u) ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
        table[i] = crc;
    }
    return table;
}

constexpr std::array<uint32_t, 256> kCrcTable = makeCrcTable();

uint32_t crc32(std::span<const std::byte> bytes) {
    uint32_t crc = 0xffffffffu;
    for (const std::byte byte : bytes) crc = kCrcTable[(crc ^ static_cast<uint32_t>(byte)) & 0xffu] ^ (crc >> 8);
    return ~crc;
}

uint32_t readBigEndian(std::span<const std::byte> bytes) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<uint32_t>(bytes[i]);
    return value;
}

void appendBigEndian(std::vector<std::byte>& file, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) file.push_back(static_cast<std::byte>(value >> shift & 0xffu));
}

void appendText(std::vector<std::byte>& file, std::string_view text) {
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    file.insert(file.end(), bytes, bytes + text.size());
}

}  // namespace

bool isPng(std::span<const std::byte> bytes) {
    return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).starts_with(kSignature);
}

std::vector<PngChunk> readPngChunks(std::span<const std::byte> bytes) {
    std::vector<PngChunk> chunks;
    for (size_t offset = kPngSignatureBytes; bytes.size() - offset >= kPngChunkOverhead;) {
        const std::span<const std::byte> rest = bytes.subspan(offset);
        const uint32_t length = readBigEndian(rest);
        if (length > rest.size() - kPngChunkOverhead) break;
        PngChunk chunk{std::string(reinterpret_cast<const char*>(rest.data()) + 4, 4), rest.subspan(8, length)};
        chunk.intact = crc32(rest.subspan(4, length + size_t{4})) == readBigEndian(rest.subspan(length + size_t{8}));
        chunks.push_back(chunk);
        if (chunk.type == "IEND") break;
        offset += length + kPngChunkOverhead;
    }
    return chunks;
}

std::optional<std::string> pngDamage(std::span<const std::byte> bytes) {
    const std::vector<PngChunk> chunks = readPngChunks(bytes);
    for (const PngChunk& chunk : chunks) {
        const bool critical = chunk.type[0] >= 'A' && chunk.type[0] <= 'Z';
        if (critical && !chunk.intact)
            return "is damaged (the checksum of its " + chunk.type + " chunk does not agree)";
    }
    if (chunks.empty() || chunks.back().type != "IEND") return "is cut short";
    return std::nullopt;
}

void appendPngChunk(std::vector<std::byte>& file, std::string_view type, std::string_view data) {
    appendBigEndian(file, static_cast<uint32_t>(data.size()));
    const size_t typeOffset = file.size();
    appendText(file, type);
    appendText(file, data);
    appendBigEndian(file, crc32(std::span(file).subspan(typeOffset)));
}

}  // namespace raylab
