#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace raylab {

/// Unit vertex normals, each triangle weighted by its angle at the vertex, so that the tessellation of a face makes no
/// difference (Thuermer and Wuethrich 1998, "Computing Vertex Normals from Polygonal Facets"). +Z where no triangle has
/// an area.
std::vector<glm::vec3> angleWeightedNormals(std::span<const glm::vec3> positions,
                                            std::span<const glm::uvec3> triangles);

/// Per-vertex tangents along increasing u, orthogonal to `normals` (Lengyel 2001, "Computing Tangent Space Basis
/// Vectors for an Arbitrary Mesh"). cross(n, t) * w points along *decreasing* v, which is up in the image, as in glTF.
/// Where the texture mapping is degenerate, any tangent. All three vertex spans have one length.
std::vector<glm::vec4> vertexTangents(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                                      std::span<const glm::vec2> uvs, std::span<const glm::uvec3> triangles);

/// Some unit vector orthogonal to the unit vector n.
glm::vec3 anyOrthogonal(glm::vec3 n);

}  // namespace raylab
