#pragma once

#include <assimp/Importer.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/gltf_geometry.h"

namespace raylab {

/// Reads a file as it is, polygons included. The scene belongs to `importer`. Files that it asks for in vain (a
/// material library) are added to `missing`. Throws Error with Assimp's message, shortened, where it refuses.
const aiScene& readSceneFile(Assimp::Importer& importer, const std::filesystem::path& path,
                             std::vector<std::string>& missing);

/// The geometry of a document: one aiMesh a part, named by the part's index (parts without a usable triangle may be
/// absent).
const aiScene& readPlainGltf(Assimp::Importer& importer, const GltfDocument& document, const PlainGltf& plain);

}  // namespace raylab
