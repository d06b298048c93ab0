#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/scene/bounds.h"
#include "engine/scene/mesh_shading.h"
#include "import_support.h"

namespace raylab::importtest {
namespace {

/// A unit triangle placed `transforms.size()` times.
Scene sceneOf(const std::vector<glm::mat4>& transforms) {
    Scene scene;
    scene.materials.emplace_back();
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    scene.meshes.push_back(mesh);
    for (const glm::mat4& transform : transforms) scene.instances.push_back({"", 0, transform});
    return scene;
}

TEST(ImportBounds, CoverAllInstancesExactly) {
    const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), 0.7853982f, glm::vec3(0, 0, 1));
    const Scene scene = sceneOf({turned, glm::translate(glm::mat4(1.0f), glm::vec3(5, 6, 7))});
    const Bounds bounds = sceneBounds(scene);
    expectNear(bounds.lo, {-std::sqrt(0.5f), 0, 0});  // the box of the turned box would be wider
    expectNear(bounds.hi, {6, 7, 7});
    EXPECT_EQ(triangleCount(scene).stored, 1u);
    EXPECT_EQ(triangleCount(scene).instanced, 2u);
}

TEST(ImportBounds, EmptySceneIsZero) {
    EXPECT_EQ(sceneBounds(Scene()).lo, glm::vec3(0));
    EXPECT_EQ(sceneBounds(Scene()).hi, glm::vec3(0));
    EXPECT_TRUE(std::isfinite(defaultCamera(Scene()).position.z));
}

/// Every corner of the box is inside the frustum, from above, and some corner comes near its edge.
TEST(ImportBounds, DefaultCameraFramesTheScene) {
    std::mt19937 random(7);  // seed 7
    std::uniform_real_distribution<float> size(0.01f, 100.0f), place(-1000.0f, 1000.0f);
    for (int round = 0; round < 100; ++round) {
        const glm::mat4 transform =
            glm::translate(glm::mat4(1.0f), glm::vec3(place(random), place(random), place(random))) *
            glm::rotate(glm::mat4(1.0f), place(random), glm::normalize(glm::vec3(1, 2, 3))) *
            glm::scale(glm::mat4(1.0f), glm::vec3(size(random), size(random), size(random)));
        const Scene scene = sceneOf({transform});
        const Camera camera = defaultCamera(scene);
        const Bounds bounds = sceneBounds(scene);
        EXPECT_GT(camera.position.y, camera.target.y);
        EXPECT_FLOAT_EQ(camera.fovYRadians, 0.7853982f);
        const glm::mat4 view = glm::lookAt(camera.position, camera.target, camera.up);
        float widest = 0.0f;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p(corner & 1 ? bounds.hi.x : bounds.lo.x, corner & 2 ? bounds.hi.y : bounds.lo.y,
                              corner & 4 ? bounds.hi.z : bounds.lo.z);
            const glm::vec3 seen(view * glm::vec4(p, 1.0f));
            ASSERT_LT(seen.z, 0.0f);
            const float tangent = std::max(std::abs(seen.x), std::abs(seen.y)) / -seen.z;
            widest = std::max(widest, tangent / std::tan(0.5f * camera.fovYRadians));
        }
        EXPECT_LE(widest, 1.001f);
        EXPECT_GT(widest, 0.3f);
    }
}

TEST(ImportShading, AnyOrthogonalIsOrthonormal) {
    std::mt19937 random(11);  // seed 11
    std::normal_distribution<float> normal;
    std::vector<glm::vec3> directions = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
    for (int i = 0; i < 1000; ++i)
        directions.push_back(glm::normalize(glm::vec3(normal(random), normal(random), normal(random))));
    for (const glm::vec3& n : directions) {
        const glm::vec3 t = anyOrthogonal(n);
        EXPECT_NEAR(glm::length(t), 1.0f, 1e-5f);
        EXPECT_NEAR(glm::dot(t, n), 0.0f, 1e-5f);
    }
}

/// A patch of a cylinder whose u runs round it: the tangent at angle a is (-sin a, cos a, 0), in closed form.
TEST(ImportShading, TangentsOfACylinder) {
    for (const bool mirrored : {false, true}) {
        std::vector<glm::vec3> positions, normals;
        std::vector<glm::vec2> uvs;
        std::vector<glm::uvec3> triangles;
        constexpr uint32_t kSteps = 64;
        for (uint32_t i = 0; i <= kSteps; ++i)
            for (const float z : {0.0f, 1.0f}) {
                const float angle = static_cast<float>(i) / kSteps;
                positions.emplace_back(std::cos(angle), std::sin(angle), z);
                normals.emplace_back(std::cos(angle), std::sin(angle), 0.0f);
                uvs.emplace_back(mirrored ? -angle : angle, 1.0f - z);  // v downwards: z is up in the image
            }
        for (uint32_t i = 0; i < 2 * kSteps; i += 2) {
            triangles.emplace_back(i, i + 2, i + 1);
            triangles.emplace_back(i + 1, i + 2, i + 3);
        }
        const std::vector<glm::vec4> tangents = vertexTangents(positions, normals, uvs, triangles);
        for (size_t i = 0; i < tangents.size(); ++i) {
            const glm::vec3 exact = glm::vec3(-normals[i].y, normals[i].x, 0.0f) * (mirrored ? -1.0f : 1.0f);
            expectNear(glm::vec3(tangents[i]), exact, 1e-4f);
            expectNear(glm::cross(normals[i], glm::vec3(tangents[i])) * tangents[i].w, {0, 0, 1}, 1e-4f);
        }
    }
}

/// On a tessellated sphere the exact normal is the position.
TEST(ImportShading, NormalsOfASphere) {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    constexpr uint32_t kRings = 64, kSegments = 128;
    for (uint32_t r = 1; r < kRings; ++r)
        for (uint32_t s = 0; s < kSegments; ++s) {
            const double theta = 3.14159265358979 * r / kRings, phi = 2 * 3.14159265358979 * s / kSegments;
            positions.emplace_back(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
        }
    for (uint32_t r = 0; r + 2 < kRings; ++r)
        for (uint32_t s = 0; s < kSegments; ++s) {
            const uint32_t a = r * kSegments + s, b = r * kSegments + (s + 1) % kSegments;
            triangles.emplace_back(a, b, a + kSegments);
            triangles.emplace_back(b, b + kSegments, a + kSegments);
        }
    const std::vector<glm::vec3> normals = angleWeightedNormals(positions, triangles);
    for (uint32_t i = kSegments; i + kSegments < positions.size(); ++i) expectNear(normals[i], positions[i], 2e-3f);
}

}  // namespace
}  // namespace raylab::importtest
