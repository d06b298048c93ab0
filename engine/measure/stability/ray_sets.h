#pragma once

#include <vector>

#include "engine/measure/stability/scene_parts.h"
#include "shaders/shared/frame.h"

/// Rays for measurements of traversals, and the scenes that they are for.
namespace raylab::stability {

inline shared::RayData makeRay(glm::vec3 origin, glm::vec3 direction, float tMin = 0.0f, float tMax = 3e38f) {
    return {origin, tMin, direction, tMax};
}

/// From around and inside the scene towards points in it; lengths of the directions from 1e-2 to 1e2.
std::vector<shared::RayData> randomRays(const Scene& scene, size_t count, uint32_t seed);

/// Triangles of about `size` scattered over the unit cube.
Scene soupScene(size_t count, float size);

/// A soup of 300 triangles 41 times, moved, turned, mirrored, stretched and sheared, and a mesh that is shown once.
Scene instancedSoup();

/// Cubes on an integer grid, so that origins and directions lie exactly in faces and along axes.
Scene gridOfCubes();

/// For gridOfCubes(): along axes or nearly so, with components of 0, -0 and denormals, from faces and edges of boxes.
/// tMin is 0 in every other ray and 1e-4 in the rest.
std::vector<shared::RayData> raysAlongAxes(size_t count, uint32_t seed);

/// Closed, of radius 2, in `rings` by 2 * `rings` cells.
TestMesh ball(uint32_t rings, const glm::vec3& centre);

/// The ball at the origin with radii between 1.6 and 2.4 from vertex to vertex.
TestMesh bumpyBall(uint32_t rings);

/// From inside a ball at its vertices and at points of its edges, in turn; `toWorld` moves both.
std::vector<shared::RayData> raysAtEdges(const TestMesh& mesh, const glm::vec3& centre, size_t count,
                                         const glm::mat4& toWorld = glm::mat4(1.0f));

/// From inside a ball in all directions.
std::vector<shared::RayData> raysFromInside(const glm::vec3& centre, size_t count);

/// One mesh of triangles, diffuse.
Scene sceneOf(const TestMesh& mesh);

/// Everything solid and diffuse, without textures: what an oracle that knows triangles alone can judge.
void makeSolid(Scene& scene);

}  // namespace raylab::stability
