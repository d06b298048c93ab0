#include "engine/measure/stability/scene_parts.h"

#include <algorithm>
#include <cmath>

namespace raylab::stability {

Material lambert(float albedo) { return lambert(glm::vec3(albedo)); }

Material lambert(glm::vec3 albedo) {
    Material material;
    material.baseColor = albedo;
    material.specular = 0.0f;
    return material;
}

Material lamp(float radiance, bool doubleSided) {
    Material material = lambert(0.0f);
    material.emission = glm::vec3(radiance);
    material.doubleSided = doubleSided;
    return material;
}

Material glass(float ior) {
    Material material;
    material.roughness = 0.0f;
    material.transmission = 1.0f;
    material.ior = ior;
    material.thin = false;
    return material;
}

uint32_t addMaterial(Scene& scene, const Material& material) {
    scene.materials.push_back(material);
    return static_cast<uint32_t>(scene.materials.size() - 1);
}

uint32_t addMesh(Scene& scene, Mesh mesh, const glm::mat4& objectToWorld) {
    scene.meshes.push_back(std::move(mesh));
    const auto index = static_cast<uint32_t>(scene.meshes.size() - 1);
    addInstance(scene, index, objectToWorld);
    return index;
}

void addInstance(Scene& scene, uint32_t mesh, const glm::mat4& objectToWorld) {
    scene.instances.push_back({"", mesh, objectToWorld});
}

Mesh quad(uint32_t material, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    Mesh mesh;
    mesh.material = material;
    mesh.positions = {a, b, c, d};
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

Mesh floorQuad(uint32_t material, float half, float y) {
    return quad(material, {-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half});
}

Mesh ceilingQuad(uint32_t material, float half, float y) {
    return quad(material, {-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half});
}

Mesh box(uint32_t material, glm::vec3 lo, glm::vec3 hi) {
    Mesh mesh;
    mesh.material = material;
    for (uint32_t i = 0; i < 8; ++i)
        mesh.positions.emplace_back((i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

Mesh smoothBall(uint32_t material, float radius, const glm::vec3& centre, uint32_t rings) {
    Mesh mesh = meshOf(sphere(radius, rings, 2 * rings, centre), material);
    for (const glm::vec3& p : mesh.positions) mesh.normals.push_back(glm::normalize(p - centre));
    return mesh;
}

Mesh meshOf(const TestMesh& mesh, uint32_t material) {
    Mesh result;
    result.material = material;
    result.positions = mesh.positions;
    result.triangles = mesh.triangles;
    return result;
}

void lookAt(Scene& scene, glm::vec3 position, glm::vec3 target, float fovYRadians) {
    scene.cameras = {Camera{"", position, target, {0.0f, 1.0f, 0.0f}, fovYRadians}};
}

void lookDown(Scene& scene, float height) {
    lookAt(scene, {0.0f, height, 0.0f}, glm::vec3(0.0f),
           static_cast<float>(2.0 * std::atan(0.5 / static_cast<double>(height))));
    scene.cameras[0].up = {0.0f, 0.0f, -1.0f};
}

void lookAtPoint(Scene& scene, glm::vec3 position, glm::vec3 target) { lookAt(scene, position, target, 1e-6f); }

Environment constantEnvironment(float radiance) {
    Environment environment{Bitmap(1, 1, 3)};
    std::fill(environment.radiance.pixels.begin(), environment.radiance.pixels.end(), radiance);
    return environment;
}

}  // namespace raylab::stability
