#pragma once

#include <assimp/Importer.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/gltf_geometry.h"

namespace raylab {

/// What was noticed about the files that a scene names.
struct FileNotes {
    std::vector<std::string> missing;  ///< asked for in vain: a material library
    std::string orphans;  ///< a material library with statements before its first material, which were left out
};

/// Reads a file as it is, polygons included. The scene belongs to `importer`. Throws Error with Assimp's message,
/// shortened, where it refuses.
const aiScene& readSceneFile(Assimp::Importer& importer, const std::filesystem::path& path,
                             FileNotes& notes);

/// The geometry of a document: one aiMesh a part, named by the part's index (parts without a usable triangle may be
/// absent).
const aiScene& readPlainGltf(Assimp::Importer& importer, const GltfDocument& document, const PlainGltf& plain);

}  // namespace raylab
