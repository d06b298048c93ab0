#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace raylab {

/// The chunk layer of PNG (PNG specification, 2nd edition, section 5): signature, then length, type, data and CRC each.

constexpr size_t kPngSignatureBytes = 8;
constexpr size_t kPngChunkOverhead = 12;  ///< length, type and CRC

struct PngChunk {
    std::string type;                 ///< four letters; the first is a capital in a chunk that a reader must know
    std::span<const std::byte> data;  ///< into the file's bytes
    bool intact = true;               ///< its CRC agrees
};

bool isPng(std::span<const std::byte> bytes);

/// Chunks up to and including IEND, or up to where the file is cut short.
std::vector<PngChunk> readPngChunks(std::span<const std::byte> bytes);

/// Why a file that isPng() is damaged, in words that follow a file name; looks at lengths and at the CRCs of critical
/// chunks, which stb_image does not.
std::optional<std::string> pngDamage(std::span<const std::byte> bytes);

/// Appends a chunk with its CRC.
void appendPngChunk(std::vector<std::byte>& file, std::string_view type, std::string_view data);

}  // namespace raylab
