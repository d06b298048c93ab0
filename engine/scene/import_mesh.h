#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/scene.h"

struct aiMesh;

namespace raylab {

/// What to do with the normals of a file: `keep` uses those that are there and shades flat without; `smooth` computes
/// them where they are missing; `flat` drops them.
enum class NormalRule { keep, smooth, flat };

/// What had to be put right, summed over meshes.
struct MeshRepairs {
    size_t notTriangles = 0;       ///< points, lines
    size_t missingVertices = 0;    ///< triangles that name a vertex which does not exist
    size_t nonFiniteVertices = 0;  ///< triangles with a vertex that is not finite or beyond 1e18
    size_t normals = 0;            ///< non-finite or zero normals, recomputed
    size_t uvs = 0;                ///< non-finite texture coordinates, set to 0

    MeshRepairs& operator+=(const MeshRepairs& other);
    /// One sentence for each kind that occurred.
    void report(std::vector<std::string>& warnings) const;
};

/// Coordinates beyond this count as non-finite: their squares would overflow a float.
constexpr float kLargestSceneCoordinate = 1e18f;

/// How texture coordinates arrive: (u, 1 - v) of Assimp's readers, or (u, *, v) of PlainGltf.
enum class UvForm { upwards, plainGltf };

struct MeshOptions {
    NormalRule normals = NormalRule::keep;
    bool weld = false;  ///< merge vertices whose attributes agree bit for bit
    UvForm uvs = UvForm::upwards;
};

/// Unit length to within the rounding of floats. Such a vector is kept as it is: normalising it again would move its
/// last bits at every import of what was saved.
bool isUnit(glm::dvec3 v);

/// Copies an Assimp mesh, polygons cut into triangles. In the result every index exists, every value is finite, every
/// normal has unit length and every vertex is used. It may have no triangles.
Mesh convertMesh(const aiMesh& source, const MeshOptions& options, MeshRepairs& repairs);

/// Merges vertices whose attributes agree bit for bit; linear in their number.
void weldVertices(Mesh& mesh);

/// Removes vertices that no triangle uses.
void compactVertices(Mesh& mesh);

/// Whether tangents change what the material looks like.
bool wantsTangents(const Material& material);

/// Supplies tangents (see vertexTangents) to a mesh with texture coordinates that has none.
void ensureTangents(Mesh& mesh);

}  // namespace raylab
