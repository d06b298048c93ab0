#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "engine/scene/scene.h"

namespace raylab {

/// Throws Error unless the extension is one that scenes are saved in: before hours of work, not after.
void requireSavable(const std::filesystem::path& path);

struct SavedFile {
    std::filesystem::path path;
    size_t bytes = 0;
};

/// Writes a scene as glTF 2.0: .glb with all in one file, or .gltf with NAME.bin and NAME.imageN.png beside it. A
/// radiance map goes into NAME.environment.exr in both cases, for glTF cannot hold one. What else glTF has no place for
/// is in `extras.raylab`: see docs/scene-format.md.
///
/// Importing the file yields the scene again, bit for bit, if the scene came from an import itself. Otherwise what the
/// importer puts right holds here too: meshes and materials that nothing shows are dropped, meshes of triangles come
/// before meshes of quadrics, textures in the order in which materials name them; a texture is sRGB where it is a
/// colour and linear where not. The scene's name is the file's. Bytes in names that are no UTF-8 are replaced.
///
/// All files are complete under temporary names before the first is renamed, and the one that names the others is
/// renamed last. Returns them, the main one last. Throws Error where requireSavable does, for a file that cannot be
/// written, and a .glb beyond the 4 GiB of its format.
std::vector<SavedFile> saveGltf(const Scene& scene, const std::filesystem::path& path);

}  // namespace raylab
