#include "engine/scene/assimp_reader.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/scene.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string_view>

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

/// Blanks out what stands before a library's first material, and says whether that was more than comments: Assimp
/// (5.2.5) writes a statement there through a null pointer.
bool blankOrphans(std::span<uint8_t> text) {
    bool orphans = false;
    for (size_t line = 0; line < text.size();) {
        const auto rest = std::string_view(reinterpret_cast<const char*>(text.data()), text.size()).substr(line);
        const std::string_view whole = rest.substr(0, rest.find('\n'));
        const size_t start = std::min(whole.find_first_not_of(" \t\r"), whole.size());
        if (whole.substr(start).starts_with("newmtl")) return orphans;
        orphans = orphans || (start < whole.size() && whole[start] != '#');
        std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(line), whole.size(), uint8_t{' '});
        line += whole.size() + 1;
    }
    return orphans;
}

/// The disk, remembering what was not found there; material libraries (whatever a scene names) begin with a material.
class RecordingDisk : public Assimp::DefaultIOSystem {
public:
    RecordingDisk(std::string scene, FileNotes& notes) : scene_(std::move(scene)), notes_(notes) {}
    Assimp::IOStream* Open(const char* path, const char* mode) override {
        Assimp::IOStream* stream = DefaultIOSystem::Open(path, mode);
        if (!stream) notes_.missing.emplace_back(path);
        return stream && path != scene_ ? libraryOf(stream, path) : stream;
    }

private:
    Assimp::IOStream* libraryOf(Assimp::IOStream* stream, const char* path) {
        const size_t size = stream->FileSize();
        auto text = std::make_unique<uint8_t[]>(size);
        const size_t read = stream->Read(text.get(), 1, size);
        DefaultIOSystem::Close(stream);
        if (blankOrphans({text.get(), read})) notes_.orphans = path;
        return new Assimp::MemoryIOStream(text.release(), read, true);
    }

    std::string scene_;
    FileNotes& notes_;
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

const aiScene& readSceneFile(Assimp::Importer& importer, const fs::path& path, FileNotes& notes) {
    importer.SetIOHandler(new RecordingDisk(path.string(), notes));  // the importer owns it
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
