#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/json_view.h"

namespace raylab {

/// A glTF 2.0 file with its buffers in memory: external ones read, data URIs decoded, the binary chunk of a GLB sliced.
struct GltfDocument {
    std::filesystem::path path;
    std::string name;  ///< of the file, for messages
    nlohmann::json json;
    std::vector<std::span<const std::byte>> buffers;  ///< one a glTF buffer, at least `byteLength` long
    std::vector<std::vector<std::byte>> storage;      ///< what the spans point into

    JsonView root() const { return JsonView(json, name); }
};

/// Reads .gltf or .glb (told apart by their first bytes) and its buffers.
/// Throws Error for a damaged container, JSON that does not parse, glTF 1.0, a missing or short buffer.
GltfDocument loadGltf(const std::filesystem::path& path);

}  // namespace raylab
