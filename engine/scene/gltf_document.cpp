#include "engine/scene/gltf_document.h"

#include <cstring>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/scene/data_uri.h"
#include "engine/scene/resource_path.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr uint32_t kChunkJson = 0x4E4F534A;
constexpr uint32_t kChunkBin = 0x004E4942;

/// The two chunks of a GLB (glTF 2.0 specification, section 4.4), or the whole file as JSON.
struct Container {
    std::span<const std::byte> json;
    std::span<const std::byte> binary;
};

uint32_t readU32(std::span<const std::byte> bytes, size_t offset) {
    uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof(value));
    return value;
}

[[noreturn]] void failDamaged(const fs::path& path, const std::string& what) {
    throw Error(path.string() + ": damaged GLB: " + what + "; copy or export the file again");
}

Container splitGlb(std::span<const std::byte> file, const fs::path& path) {
    if (file.size() < 20) failDamaged(path, "only " + std::to_string(file.size()) + " bytes long");
    if (const uint32_t version = readU32(file, 4); version != 2)
        throw Error(path.string() + ": binary glTF version " + std::to_string(version) +
                    "; only version 2 is read, convert it");
    const size_t length = readU32(file, 8);
    if (length > file.size())
        failDamaged(path, "its header promises " + std::to_string(length) + " bytes, there are " +
                              std::to_string(file.size()) + " (truncated?)");
    Container container;
    for (size_t offset = 12; offset + 8 <= length;) {
        const size_t chunkLength = readU32(file, offset);
        const uint32_t chunkType = readU32(file, offset + 4);
        if (chunkLength > length - offset - 8) failDamaged(path, "a chunk reaches past the end of the file");
        const std::span<const std::byte> chunk = file.subspan(offset + 8, chunkLength);
        if (chunkType == kChunkJson && container.json.empty()) container.json = chunk;
        if (chunkType == kChunkBin && container.binary.empty()) container.binary = chunk;
        offset += 8 + chunkLength;
    }
    if (container.json.empty()) failDamaged(path, "there is no JSON chunk in it");
    return container;
}

Container splitContainer(std::span<const std::byte> file, const fs::path& path) {
    if (file.size() >= 4 && readU32(file, 0) == kMagic) return splitGlb(file, path);
    return {.json = file, .binary = {}};
}

nlohmann::json parseJson(std::span<const std::byte> text, const fs::path& path) {
    const char* first = reinterpret_cast<const char*>(text.data());
    try {
        nlohmann::json document = nlohmann::json::parse(first, first + text.size());
        if (!document.is_object()) throw Error(path.string() + ": is JSON, but not a glTF document");
        return document;
    } catch (const nlohmann::json::exception& problem) {
        std::string message = problem.what();
        if (message.size() > 160) message = message.substr(0, 160) + "...";
        throw Error(path.string() + ": not valid JSON: " + message + "; copy or export the file again");
    }
}

void requireVersion2(const JsonView& root) {
    if (!root.has("asset")) root.fail("has no \"asset\" entry, so it is not glTF 2.0");
    const std::string version = root.object("asset").text("version", "");
    if (!version.starts_with("2."))
        throw Error(root.file() + ": glTF version \"" + version + "\"; only 2.x is read, convert it");
}

std::vector<std::byte> bytesOfUri(const GltfDocument& document, const std::string& uri, size_t buffer) {
    const std::string place = document.path.string() + ": buffers[" + std::to_string(buffer) + "]";
    if (isDataUri(uri)) return decodeDataUri(uri, place);
    try {
        return readFile(resolveResource(document.path.parent_path(), uri));
    } catch (const Error& problem) {
        throw Error(place + " is a file of its own: " + problem.what());
    }
}

/// Bytes of buffer `i`; appends to `document.storage` what has no home yet.
std::span<const std::byte> loadBuffer(GltfDocument& document, const JsonView& buffer, size_t i,
                                      std::span<const std::byte> binaryChunk) {
    const size_t byteLength = buffer.count("byteLength", 0);
    std::span<const std::byte> bytes = binaryChunk;
    if (buffer.has("uri")) {
        document.storage.push_back(bytesOfUri(document, buffer.text("uri", ""), i));
        bytes = document.storage.back();
    } else if (i != 0) {
        buffer.fail("has no uri");
    }
    if (bytes.size() < byteLength)
        buffer.fail("promises " + std::to_string(byteLength) + " bytes, there are " + std::to_string(bytes.size()) +
                    " (truncated?)");
    return bytes.first(byteLength);
}

}  // namespace

GltfDocument loadGltf(const fs::path& path) {
    GltfDocument document{.path = path, .name = path.string(), .json = {}, .buffers = {}, .storage = {}};
    document.storage.push_back(readFile(path));
    const Container container = splitContainer(document.storage.front(), path);
    document.json = parseJson(container.json, path);
    const JsonView root = document.root();
    requireVersion2(root);
    const JsonView buffers = root.array("buffers");
    for (size_t i = 0; i < buffers.size(); ++i)
        document.buffers.push_back(loadBuffer(document, buffers.element(i), i, container.binary));
    return document;
}

}  // namespace raylab
