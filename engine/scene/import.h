#pragma once

#include <filesystem>
#include <string>

#include "engine/scene/scene.h"

namespace raylab {

/// Reads a scene: glTF 2.0 (.gltf, .glb; quadrics, sun and environment in extras of ours), OBJ with MTL, PLY or STL.
///
/// In the result every index exists and every number is finite; each mesh has at least one primitive and one
/// instance, each material a mesh. What had to be left out or put right is a sentence in Scene::warnings: a missing
/// texture, triangles with non-finite vertices (or beyond 1e18), singular instance transforms, features that the data
/// model has no place for. Degenerate triangles stay.
///
/// Missing normals: PLY gets smooth ones (a scan), the others are flat. STL is flat always. A mesh without a material
/// is a grey Lambertian of reflectance 0.8.
///
/// Throws Error: no such file, a folder, an extension that is not read, a damaged file, or one without any surface to
/// render.
Scene importScene(const std::filesystem::path& path);

/// ".gltf .glb .obj .ply .stl", for messages and file dialogs.
std::string importableExtensions();

}  // namespace raylab
