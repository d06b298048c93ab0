#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/import_mesh.h"
#include "engine/scene/import_texture.h"
#include "engine/scene/scene.h"

namespace raylab {

/// A scene on its way in. The texture indices of its materials count `requests`; meshes may be empty and transforms
/// singular.
struct SceneDraft {
    Scene scene;
    TextureRequests requests;
    MeshRepairs repairs;
    std::vector<std::string> singular;  ///< instances that were left out
};

/// ".glb" of "a.GLB".
std::string lowerExtension(const std::filesystem::path& path);

/// Whether all that the transform holds is finite and at most kLargestSceneCoordinate.
bool isBounded(const glm::dmat4& transform);

/// Singular is meant relative to the lengths of the columns: a scene at 1e-4 of its size is fine, a flattened one is
/// not. A float matrix cannot tell less than 1e-7 from 0.
bool isInvertible(const glm::dmat4& matrix);

/// Adds an instance unless its transform is singular or not finite; finishScene then names it in a warning. Where a matrix
/// between the two is singular, the instance stands still, with a warning.
void placeInstance(SceneDraft& draft, const std::string& name, size_t mesh, const glm::dmat4& toWorld,
                   const glm::dmat4& endToWorld);

/// Drops meshes without primitives or instances and materials without meshes, computes tangents where a normal map asks
/// for them, decodes the textures and writes the report on repairs. What the images point to must still be alive.
/// Throws Error where no surface is left.
Scene finishScene(SceneDraft&& draft, const std::filesystem::path& path);

/// The two ways in; importScene chooses by the extension (in lower case, with its dot).
Scene importGltf(const std::filesystem::path& path);
Scene importThroughAssimp(const std::filesystem::path& path, const std::string& extension);

}  // namespace raylab
