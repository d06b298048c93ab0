#include "tests/support/scene_build.h"

#include <glm/gtc/matrix_transform.hpp>

namespace raylab::support {

Scene quadricScene(uint32_t seed) {
    accel_test::Random random(seed);
    const auto between = [&](float low, float high) { return random.uniform(low, high); };
    Scene scene;
    const uint32_t material = addMaterial(scene, lambert(0.6f));
    for (uint32_t kind = 0; kind < 5; ++kind) {
        Mesh mesh;
        mesh.material = material;
        for (int i = 0; i < 3; ++i)
            mesh.quadrics.push_back({static_cast<QuadricKind>(kind),
                                     {between(0.2f, 0.8f), between(0.2f, 0.8f), between(0.2f, 0.8f)},
                                     between(-0.7f, 0.1f),
                                     between(0.2f, 0.9f)});
        scene.meshes.push_back(mesh);
        for (int i = 0; i < 8; ++i) {
            glm::mat4 matrix = glm::translate(glm::mat4(1.0f), {between(-4, 4), between(-4, 4), between(-4, 4)});
            matrix = glm::rotate(matrix, between(0, 6), glm::vec3(between(0.1f, 1), between(-1, 1), between(-1, 1)));
            matrix = glm::scale(matrix, {between(0.5f, 2), between(-2, -0.5f), between(0.5f, 2)});
            matrix[1] += between(-0.5f, 0.5f) * matrix[0];
            addInstance(scene, kind, matrix);
        }
    }
    addMesh(scene, floorQuad(material, 5.0f, -2.0f));
    addMesh(scene, box(material, {-1, -1, -1}, {1, 0, 1}));
    return scene;
}

}  // namespace raylab::support
