#include "engine/scene/assimp_reader.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/scene.h>

#include <map>

#include "engine/core/error.h"

namespace raylab {
namespace {

namespace fs = std::filesystem;

/// Files in memory, found by their bare names.
class MemoryFiles : public Assimp::IOSystem {
public:
    void add(const std::string& name, std::span<const std::byte> bytes) { files_[name] = bytes; }
    bool Exists(const char* path) const override { return files_.contains(fs::path(path).filename().string()); }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* path, const char*) override {
        const auto found = files_.find(fs::path(path).filename().string());
        if (found == files_.end()) return nullptr;
        return new Assimp::MemoryIOStream(reinterpret_cast<const uint8_t*>(found->second.data()), found->second.size());
    }
    void Close(Assimp::IOStream* stream) override { delete stream; }

private:
    std::map<std::string, std::span<const std::byte>> files_;
};

/// The disk, remembering what was not found there.
class RecordingDisk : public Assimp::DefaultIOSystem {
public:
    explicit RecordingDisk(std::vector<std::string>& missing) : missing_(missing) {}
    Assimp::IOStream* Open(const char* path, const char* mode) override {
        Assimp::IOStream* stream = DefaultIOSystem::Open(path, mode);
        if (!stream) missing_.emplace_back(path);
        return stream;
    }

private:
    std::vector<std::string>& missing_;
};

std::string shortened(std::string message) {
    message = message.substr(0, message.find('\n'));
    return message.size() > 200 ? message.substr(0, 200) + "..." : message;
}

[[noreturn]] void failRead(const fs::path& path, const std::string& why) {
    throw Error(path.string() + ": cannot be read, damaged or not what its extension says (" +
                shortened(why.empty() ? "no reason given" : why) + "); copy or export the file again");
}

/// No post-processing: aiProcess_Triangulate of 5.2.5 aborts on faces without corners.
const aiScene& read(Assimp::Importer& importer, const std::string& name, const fs::path& path) {
    const aiScene* scene = nullptr;
    try {
        scene = importer.ReadFile(name, 0);
    } catch (const std::exception& problem) {
        failRead(path, problem.what());
    }
    if (!scene || !scene->mRootNode) failRead(path, importer.GetErrorString());
    return *scene;
}

}  // namespace

const aiScene& readSceneFile(Assimp::Importer& importer, const fs::path& path, std::vector<std::string>& missing) {
    importer.SetIOHandler(new RecordingDisk(missing));  // the importer owns it
    return read(importer, path.string(), path);
}

const aiScene& readPlainGltf(Assimp::Importer& importer, const GltfDocument& document, const PlainGltf& plain) {
    auto* files = new MemoryFiles;
    importer.SetIOHandler(files);  // the importer owns it
    files->add("plain.gltf", std::as_bytes(std::span(plain.json)));
    files->add("unrolled", plain.unrolled);
    for (size_t b = 0; b < document.buffers.size(); ++b) files->add("buffer" + std::to_string(b), document.buffers[b]);
    return read(importer, "plain.gltf", document.path);
}

}  // namespace raylab
