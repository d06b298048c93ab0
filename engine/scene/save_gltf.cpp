#include "engine/scene/save_gltf.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <glm/trigonometric.hpp>
#include <limits>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/image8.h"
#include "engine/image/image_io.h"
#include "engine/scene/import_parts.h"
#include "engine/scene/save_parts.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Bytes = std::vector<std::byte>;

/// A file to be written together with others.
struct PendingFile {
    fs::path path;
    std::function<void(const fs::path& temporary)> write;
};

PendingFile pendingBytes(const fs::path& path, Bytes bytes) {
    return {path, [bytes = std::move(bytes)](const fs::path& temporary) { writeFileAtomically(temporary, bytes); }};
}

/// Every file is whole under its temporary name before the first one gets its own; the last of the list comes last.
void writeTogether(std::span<const PendingFile> files) {
    if (files.empty()) return;
    writeFileAtomically(files.back().path, [&](const fs::path& temporary) {
        files.back().write(temporary);
        writeTogether(files.first(files.size() - 1));
    });
}

/// RFC 3986, section 2.1.
std::string percentEncoded(const std::string& name) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string encoded;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || c == '-' || c == '.' || c == '_' || c == '~')
            encoded += c;
        else
            encoded += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
    return encoded;
}

/// A file beside the main one, named after it.
fs::path companion(const fs::path& path, const std::string& suffix) {
    return path.parent_path() / (path.stem().string() + suffix);
}

std::vector<Bytes> encodeImages(const SharedList<Texture>& textures) {
    std::vector<Bytes> images(textures.size());
    tbb::parallel_for(size_t{0}, textures.size(), [&](size_t t) {
        images[t] = encodePng8(textures[t].texels, textures[t].width, textures[t].height);
    });
    return images;
}

void embedImages(const Scene& scene, GltfDraft& draft) {
    const std::vector<Bytes> images = encodeImages(scene.textures);
    for (size_t t = 0; t < images.size(); ++t)
        appendTo(draft.document, "images",
                 {{"name", scene.textures[t].name},
                  {"bufferView", addBufferView(draft, images[t])},
                  {"mimeType", "image/png"}});
}

void nameImages(const Scene& scene, const fs::path& path, json& document, std::vector<PendingFile>& files) {
    std::vector<Bytes> images = encodeImages(scene.textures);
    for (size_t t = 0; t < images.size(); ++t) {
        const fs::path file = companion(path, ".image" + std::to_string(t) + ".png");
        appendTo(document, "images",
                 {{"name", scene.textures[t].name}, {"uri", percentEncoded(file.filename().string())}});
        files.push_back(pendingBytes(file, std::move(images[t])));
    }
}

/// The range is that of the reader; 90 degrees in radians, as a float, is a little more.
double degrees(float radians, double limit) {
    return std::clamp(glm::degrees(static_cast<double>(radians)), -limit, limit);
}

void addSurroundings(const Scene& scene, const fs::path& path, json& document, std::vector<PendingFile>& files) {
    if (scene.sky) {
        const SkyDescription& sky = *scene.sky;
        document["extras"]["raylab"]["sun"] = {{"elevation", degrees(sky.sunElevationRadians, 90.0)},
                                               {"azimuth", degrees(sky.sunAzimuthRadians, 360.0)},
                                               {"turbidity", sky.turbidity},
                                               {"scale", sky.scale}};
    }
    if (scene.environment) {
        const fs::path file = companion(path, ".environment.exr");
        document["extras"]["raylab"]["environment"] = percentEncoded(file.filename().string());
        files.push_back({file, [&radiance = scene.environment->radiance](const fs::path& temporary) {
                             const Layer layer{.name = "", .bitmap = radiance};
                             writeExr(temporary, std::span(&layer, 1));
                         }});
    }
}

std::string dumped(const json& document) { return document.dump(-1, ' ', false, json::error_handler_t::replace); }

void appendU32(Bytes& file, size_t value) {
    for (int shift = 0; shift < 32; shift += 8) file.push_back(static_cast<std::byte>(value >> shift & 0xFF));
}

void appendChunk(Bytes& file, const char* type, std::span<const std::byte> bytes, char filler) {
    const size_t padding = (4 - bytes.size() % 4) % 4;
    appendU32(file, bytes.size() + padding);
    for (int i = 0; i < 4; ++i) file.push_back(static_cast<std::byte>(type[i]));
    file.insert(file.end(), bytes.begin(), bytes.end());
    file.insert(file.end(), padding, static_cast<std::byte>(filler));
}

/// glTF 2.0, section 4.4.
Bytes glbFile(GltfDraft& draft, const fs::path& path) {
    if (!draft.binary.empty()) draft.document["buffers"] = {{{"byteLength", draft.binary.size()}}};
    const std::string text = dumped(draft.document);
    const size_t length = 12 + 8 + (text.size() + 3) / 4 * 4 + 8 + (draft.binary.size() + 3) / 4 * 4;
    if (length > std::numeric_limits<uint32_t>::max())
        throw Error(path.string() + ": the scene takes " + std::to_string(length) +
                    " bytes, more than the 4 GiB of a .glb; save it as .gltf");
    Bytes file;
    file.reserve(length);
    for (const char c : {'g', 'l', 'T', 'F'}) file.push_back(static_cast<std::byte>(c));
    appendU32(file, 2);
    appendU32(file, length);
    appendChunk(file, "JSON", std::as_bytes(std::span(text)), ' ');
    appendChunk(file, "BIN\0", draft.binary, '\0');
    return file;
}

/// The .gltf itself; its buffer goes into a file of its own.
Bytes gltfFile(GltfDraft& draft, const fs::path& path, std::vector<PendingFile>& files) {
    if (!draft.binary.empty()) {
        const fs::path file = companion(path, ".bin");
        draft.document["buffers"] = {
            {{"byteLength", draft.binary.size()}, {"uri", percentEncoded(file.filename().string())}}};
        files.push_back(pendingBytes(file, std::move(draft.binary)));
    }
    const std::string text = dumped(draft.document);
    const auto bytes = std::as_bytes(std::span(text));
    return Bytes(bytes.begin(), bytes.end());
}

}  // namespace

size_t appendTo(json& owner, const char* key, json entry) {
    owner[key].push_back(std::move(entry));
    return owner[key].size() - 1;
}

void useExtension(json& document, const char* name) {
    const json& used = document["extensionsUsed"];
    if (std::find(used.begin(), used.end(), name) == used.end()) appendTo(document, "extensionsUsed", name);
}

size_t addBufferView(GltfDraft& draft, std::span<const std::byte> bytes) {
    draft.binary.resize((draft.binary.size() + 3) / 4 * 4);
    const size_t offset = draft.binary.size();
    draft.binary.insert(draft.binary.end(), bytes.begin(), bytes.end());
    return appendTo(draft.document, "bufferViews",
                    {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

json toJson(glm::vec3 v) { return json::array({v.x, v.y, v.z}); }

void requireSavable(const fs::path& path) {
    const std::string extension = lowerExtension(path);
    if (extension != ".glb" && extension != ".gltf")
        throw Error(path.string() + ": \"" + extension +
                    "\" is not a format that scenes are saved in; use .glb or .gltf");
}

std::vector<SavedFile> saveGltf(const Scene& scene, const fs::path& path) {
    requireSavable(path);
    const bool binary = lowerExtension(path) == ".glb";
    GltfDraft draft;
    draft.document = {{"asset", {{"version", "2.0"}, {"generator", "raylab"}}},
                      {"scene", 0},
                      {"scenes", json::array({{{"name", scene.name}}})}};
    std::vector<PendingFile> files;
    addMaterials(scene, draft.document);
    addMeshesAndNodes(scene, draft);
    addSurroundings(scene, path, draft.document, files);
    if (binary)
        embedImages(scene, draft);
    else
        nameImages(scene, path, draft.document, files);
    Bytes main = binary ? glbFile(draft, path) : gltfFile(draft, path, files);
    draft.binary = {};
    files.push_back(pendingBytes(path, std::move(main)));
    writeTogether(files);
    std::vector<SavedFile> saved;
    for (const PendingFile& file : files) saved.push_back({file.path, fs::file_size(file.path)});
    return saved;
}

}  // namespace raylab
