#include "engine/measure/stability/ray_sets.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/scene/bounds.h"

namespace raylab::stability {
std::vector<shared::RayData> randomRays(const Scene& scene, size_t count, uint32_t seed) {
    Random random(seed);
    const Bounds bounds = sceneBounds(scene);
    const glm::vec3 centre = 0.5f * (bounds.lo + bounds.hi), extent = bounds.hi - bounds.lo;
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = centre + random.inCube(-1.0f, 1.0f) * extent;
        const glm::vec3 target = centre + random.inCube(-0.5f, 0.5f) * extent;
        rays.push_back(makeRay(origin, std::pow(10.0f, random.uniform(-2.0f, 2.0f)) * glm::normalize(target - origin)));
    }
    return rays;
}

Scene soupScene(size_t count, float size) { return sceneOf(randomSoup(count, size, 81)); }

Scene instancedSoup() {
    Scene scene = soupScene(300, 0.3f);
    Random random(83);
    for (int i = 0; i < 40; ++i) {
        glm::mat4 matrix = glm::translate(glm::mat4(1.0f), random.inCube(-4.0f, 4.0f));
        matrix = glm::rotate(matrix, random.uniform(0.0f, 6.0f), random.direction());
        matrix = glm::scale(matrix, random.inCube(0.2f, 2.0f) * (i % 3 == 0 ? glm::vec3(-1, 1, 1) : glm::vec3(1.0f)));
        if (i % 4 == 0) matrix[1] += 0.5f * matrix[0];
        addInstance(scene, 0, matrix);
    }
    addMesh(scene, floorQuad(0, 3.0f, -0.37f), glm::rotate(glm::mat4(1.0f), 0.2f, {1.0f, 0.0f, 0.3f}));
    return scene;
}

Scene gridOfCubes() {
    Scene scene;
    const uint32_t material = addMaterial(scene, lambert(0.5f));
    for (int i = 0; i < 64; ++i) {
        const glm::vec3 lo = 2.0f * glm::vec3(glm::ivec3(i, i >> 2, i >> 4) & 3);
        addMesh(scene, box(material, lo, lo + 1.0f));
    }
    return scene;
}

std::vector<shared::RayData> raysAlongAxes(size_t count, uint32_t seed) {
    Random random(seed);
    const std::array<float, 5> tiny = {0.0f, -0.0f, 1e-42f, -1e-42f, 1e-30f};
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) {
        glm::vec3 origin = random.inCube(-2.0f, 9.0f);
        for (int axis = 0; axis < 3; ++axis)
            if (random.below(2) == 0) origin[axis] = static_cast<float>(random.below(9)) - 1.0f;
        const auto axis = static_cast<int>(random.below(3));
        glm::vec3 d(tiny[random.below(5)], tiny[random.below(5)], tiny[random.below(5)]);
        d[axis] = random.below(2) == 0 ? 1.0f : -1.0f;
        if (i % 5 == 0) d[(axis + 1) % 3] = random.uniform(-1.0f, 1.0f);
        rays.push_back(makeRay(origin, d, i % 2 == 0 ? 0.0f : 1e-4f));
    }
    return rays;
}

TestMesh ball(uint32_t rings, const glm::vec3& centre) { return sphere(2.0f, rings, 2 * rings, centre); }

TestMesh bumpyBall(uint32_t rings) {
    TestMesh mesh = ball(rings, glm::vec3(0.0f));
    Random random(92);
    for (glm::vec3& p : mesh.positions) p *= random.uniform(0.8f, 1.2f);
    return mesh;
}

std::vector<shared::RayData> raysAtEdges(const TestMesh& mesh, const glm::vec3& centre, size_t count,
                                         const glm::mat4& toWorld) {
    Random random(91);
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 origin = centre + random.inCube(-0.9f, 0.9f);
        const glm::uvec3& triangle = mesh.triangles[random.below(static_cast<uint32_t>(mesh.triangles.size()))];
        const auto corner = static_cast<int>(random.below(3));
        const glm::vec3& a = mesh.positions[triangle[corner]];
        const glm::vec3& b = mesh.positions[triangle[(corner + 1) % 3]];
        const glm::vec3 target = i % 2 == 0 ? a : a + random.uniform(0.0f, 1.0f) * (b - a);
        const glm::vec3 from(toWorld * glm::vec4(origin, 1.0f));
        const glm::vec3 direction = glm::vec3(toWorld * glm::vec4(target, 1.0f)) - from;
        rays.push_back(makeRay(from, i % 3 == 0 ? direction : glm::normalize(direction)));
    }
    return rays;
}

std::vector<shared::RayData> raysFromInside(const glm::vec3& centre, size_t count) {
    Random random(94);
    std::vector<shared::RayData> rays;
    for (size_t i = 0; i < count; ++i) rays.push_back(makeRay(centre + random.inCube(-0.9f, 0.9f), random.direction()));
    return rays;
}

Scene sceneOf(const TestMesh& mesh) {
    Scene scene;
    addMesh(scene, meshOf(mesh, addMaterial(scene, lambert(0.5f))));
    return scene;
}

void makeSolid(Scene& scene) {
    scene.textures.clear();
    for (Material& material : scene.materials) material = lambert(0.5f);
}

}  // namespace raylab::stability
