#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "engine/measure/stability/test_mesh.h"
#include "engine/scene/scene.h"

/// Scenes built in code.
namespace raylab::stability {

constexpr double kPi = 3.14159265358979323846;

/// Purely Lambertian.
Material lambert(glm::vec3 albedo);
Material lambert(float albedo);

/// Albedo 0; emits from both faces where `doubleSided`.
Material lamp(float radiance, bool doubleSided = false);

/// Boundary of a solid of smooth, clear glass.
Material glass(float ior = 1.5f);

/// Adds the material and returns its index.
uint32_t addMaterial(Scene& scene, const Material& material);

/// Adds the mesh and one instance of it. Returns the mesh's index.
uint32_t addMesh(Scene& scene, Mesh mesh, const glm::mat4& objectToWorld = glm::mat4(1.0f));

void addInstance(Scene& scene, uint32_t mesh, const glm::mat4& objectToWorld);

/// a, b, c, d counter-clockwise as seen from the front; texture coordinates (0,1), (1,1), (1,0), (0,0).
Mesh quad(uint32_t material, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d);

/// The square |x|, |z| <= half at height y, front upwards.
Mesh floorQuad(uint32_t material, float half, float y = 0.0f);

/// As floorQuad, front downwards.
Mesh ceilingQuad(uint32_t material, float half, float y);

/// Closed, fronts outwards.
Mesh box(uint32_t material, glm::vec3 lo, glm::vec3 hi);

/// A ball of rings by 2 * rings cells with the ball's own normals.
Mesh smoothBall(uint32_t material, float radius, const glm::vec3& centre, uint32_t rings = 24);

/// One mesh.
Mesh meshOf(const TestMesh& mesh, uint32_t material);

/// Replaces the cameras by one.
void lookAt(Scene& scene, glm::vec3 position, glm::vec3 target, float fovYRadians);

/// From above, +X to the right: a square image shows exactly the unit square of the plane y = 0 around the origin.
void lookDown(Scene& scene, float height);

/// A view so narrow that the whole image shows one point.
void lookAtPoint(Scene& scene, glm::vec3 position, glm::vec3 target);

/// A latitude-longitude map from a function of the direction.
template <class Radiance>
Environment environmentOf(int width, int height, Radiance&& radiance) {
    Environment environment{Bitmap(width, height, 3)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double theta = kPi * (y + 0.5) / height;
            const double phi = 2.0 * kPi * ((x + 0.5) / width - 0.5);
            const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
            for (int c = 0; c < 3; ++c) environment.radiance.at(x, y)[c] = static_cast<float>(radiance(d));
        }
    return environment;
}

/// The same radiance from everywhere.
Environment constantEnvironment(float radiance);

}  // namespace raylab::stability
