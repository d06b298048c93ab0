#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/support/estimate.h"
#include "tests/support/gpu_test.h"
#include "tests/support/scene_build.h"
#include "tests/support/trace_choice.h"

/// S4 and S21: surfaces that shadow themselves, and lights and cameras in places where a formula divides by zero.
namespace raylab::support {
namespace {

/// A square of `half` around `centre`, its front along +Y, cut into 8 by 8 squares of two triangles.
Mesh tessellatedFloor(uint32_t material, float half, const glm::vec3& centre) {
    constexpr uint32_t kCells = 8;
    Mesh mesh;
    mesh.material = material;
    for (uint32_t z = 0; z <= kCells; ++z)
        for (uint32_t x = 0; x <= kCells; ++x) {
            const auto along = [half](uint32_t i) { return half * (2.0f * static_cast<float>(i) / kCells - 1.0f); };
            mesh.positions.push_back(centre + glm::vec3(along(x), 0.0f, along(z)));
        }
    for (uint32_t z = 0; z < kCells; ++z)
        for (uint32_t x = 0; x < kCells; ++x) {
            const uint32_t a = z * (kCells + 1) + x, b = a + kCells + 1;
            mesh.triangles.emplace_back(a, b, b + 1);
            mesh.triangles.emplace_back(a, b + 1, a + 1);
        }
    return mesh;
}

/// Turns +Y to a direction that is no axis, without scaling.
glm::mat4 tilt() { return glm::rotate(glm::mat4(1.0f), 0.9f, glm::normalize(glm::vec3(1.0f, 0.3f, -0.5f))); }

class SelfHit : public GpuTest {
protected:
    /// Sun and white sky on the plane that `mesh` shows by `matrix`, seen by a camera above its middle: every pixel is
    /// exact, where no ray that leaves the plane comes back to it.
    void expectEvenlyLit(const Mesh& mesh, const glm::mat4& matrix, const glm::vec3& middle, float half,
                         double tolerance) {
        for (const float sunDegrees : {30.0f, 85.0f}) {
            Scene scene;
            addMaterial(scene, lambert(0.5f));
            addMesh(scene, mesh, matrix);
            scene.environment = constantEnvironment(1.0f);
            const double angle = glm::radians(static_cast<double>(sunDegrees));
            const glm::dvec3 towardsSun(std::sin(angle), std::cos(angle), 0.0);
            Light sun;
            sun.kind = LightKind::directional;
            sun.direction = glm::normalize(glm::vec3(-(glm::dmat3(matrix) * towardsSun)));
            sun.intensity = glm::vec3(static_cast<float>(kPi));
            scene.lights = {sun};
            const glm::mat3 turn(matrix);
            lookAt(scene, glm::vec3(matrix * glm::vec4(middle, 1.0f)) + turn * (half * glm::vec3(0.3f, 2.0f, 0.2f)),
                   glm::vec3(matrix * glm::vec4(middle, 1.0f)), 0.6f);
            const double exact = 0.5 + 0.5 * std::cos(angle);
            const std::string what = "half " + std::to_string(half) + ", sun at " + std::to_string(sunDegrees);
            const RenderSettings flat = smallImage(16, 16, 2);
            expectEveryPixel(renderFilm(device_, scene, flat), exact, tolerance, what);
            if (matrix == glm::mat4(1.0f)) continue;
            // Shown a second time, far below, the mesh has a tree of its own.
            addInstance(scene, 0, glm::translate(glm::mat4(1.0f), -1e3f * half * turn[1]) * matrix);
            expectEveryPixel(renderFilm(device_, scene, twoLevels(flat)), exact, tolerance, what + ", two levels");
        }
    }
};

TEST_F(SelfHit, PlaneAtEveryScale) {
    for (const float half : {1e-3f, 1.0f, 1e3f, 1e5f})
        expectEvenlyLit(tessellatedFloor(0, half, glm::vec3(0.0f)), glm::mat4(1.0f), glm::vec3(0.0f), half, 1e-5);
}

/// Tilted by its vertices: rounded, neighbouring triangles are no longer quite coplanar.
TEST_F(SelfHit, TiltedPlaneAtEveryScale) {
    for (const float half : {1e-3f, 1.0f, 1e5f}) {
        Mesh mesh = tessellatedFloor(0, half, glm::vec3(0.0f));
        Scene scene;
        addMaterial(scene, lambert(0.5f));
        for (glm::vec3& p : mesh.positions) p = glm::vec3(tilt() * glm::vec4(p, 1.0f));
        addMesh(scene, mesh);
        scene.environment = constantEnvironment(1.0f);
        lookAt(scene, glm::mat3(tilt()) * (half * glm::vec3(0.3f, 2.0f, 0.2f)), glm::vec3(0.0f), 0.6f);
        expectEveryPixel(renderFilm(device_, scene, smallImage(16, 64, 2)), 0.5, 1e-5, "half " + std::to_string(half));
    }
}

/// Where a unit in the last place is 1e-3.
TEST_F(SelfHit, PlaneFarFromTheOrigin) {
    const glm::vec3 middle(1e4f, 1e4f, -1e4f);
    for (const float half : {1.0f, 1e3f})
        expectEvenlyLit(tessellatedFloor(0, half, middle), glm::mat4(1.0f), middle, half, 1e-5);
}

/// The same planes as instances: rays take the way into object space and back.
TEST_F(SelfHit, InstancedPlane) {
    const std::pair<float, glm::vec3> cases[] = {{1.0f, glm::vec3(0.0f)}, {1e3f, glm::vec3(200.0f, -500.0f, 300.0f)}};
    for (const auto& [scale, shift] : cases) {
        const glm::mat4 matrix = glm::scale(glm::translate(glm::mat4(1.0f), shift) * tilt(), glm::vec3(scale));
        expectEvenlyLit(tessellatedFloor(0, 1.0f, glm::vec3(0.0f)), matrix, glm::vec3(0.0f), 1.0f, 1e-4);
    }
}

using Finite = GpuTest;

void expectFinite(Device& device, const Scene& scene, bool lit) {
    for (const char* needs : {"scene", "full"}) {
        RenderSettings settings = smallImage(16, 32, 8);
        settings.needs = needs;
        const FilmImage film = renderFilm(device, scene, settings);
        EXPECT_EQ(film.nonFinitePixels, 0u) << needs;
        EXPECT_EQ(estimateOf(film).mean > 0.0, lit) << needs;
    }
}

/// S21: a lamp of which no area is left gives no light and no NaN, alone and beside a lamp that has some.
TEST_F(Finite, LampWithoutArea) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.8f)), 2.0f));
    const uint32_t material = addMaterial(scene, lamp(10.0f, true));
    accel_test::TestMesh needle;
    needle.add({0, 1, 0}, {1, 1, 0}, {0.5f, 1, 0});
    needle.add({0, 1, 0}, {0, 1, 0}, {0, 1, 0});
    addMesh(scene, meshOf(needle, material));
    lookAt(scene, {1.0f, 2.0f, 3.0f}, glm::vec3(0.0f), 0.8f);
    expectFinite(device_, scene, false);
    addMesh(scene, ceilingQuad(material, 0.3f, 1.5f));
    expectFinite(device_, scene, true);
}

/// S21: a point light exactly on a surface, and lamps that share edges and planes with what they light.
TEST_F(Finite, LightsOnSurfaces) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.8f)), 2.0f));
    addMesh(scene, floorQuad(addMaterial(scene, lamp(3.0f, true)), 0.5f));
    addMesh(scene, quad(1, {0.5f, 0, 0.5f}, {0.5f, 0, -0.5f}, {0.5f, 1, -0.5f}, {0.5f, 1, 0.5f}));
    Light onFloor;
    onFloor.position = {-1.0f, 0.0f, 0.0f};
    scene.lights = {onFloor};
    lookAt(scene, {-1.0f, 2.0f, 3.0f}, glm::vec3(0.0f), 0.8f);
    expectFinite(device_, scene, true);
}

/// S21: nothing of a light that a closed box of black surrounds reaches the plane; inside it all stays finite.
TEST_F(Finite, LightInsideAMesh) {
    Scene scene;
    addMesh(scene, floorQuad(addMaterial(scene, lambert(0.8f)), 3.0f));
    addMesh(scene, box(addMaterial(scene, lambert(0.0f)), {-0.5f, 0.5f, -0.5f}, {0.5f, 1.5f, 0.5f}));
    Light enclosed;
    enclosed.position = {0.1f, 1.0f, 0.2f};
    enclosed.intensity = glm::vec3(100.0f);
    scene.lights = {enclosed};
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(50.0f, true)), 0.2f, 1.2f));
    lookAt(scene, {1.0f, 2.0f, 4.0f}, glm::vec3(0.0f), 0.8f);
    expectFinite(device_, scene, false);
}

/// S17, S21: camera inside a ball of glass inside a smooth, tight metal box with a lamp.
TEST_F(Finite, CameraInsideGlass) {
    Scene scene;
    Mesh ball = meshOf(accel_test::sphere(1.0f, 16, 32, glm::vec3(0.0f)), addMaterial(scene, glass()));
    for (const glm::vec3& p : ball.positions) ball.normals.push_back(glm::normalize(p));
    addMesh(scene, std::move(ball));
    Material metal;
    metal.metallic = 1.0f;
    metal.roughness = 0.05f;
    addMesh(scene, box(addMaterial(scene, metal), glm::vec3(-1.0f), glm::vec3(1.0f)));
    addMesh(scene, ceilingQuad(addMaterial(scene, lamp(5.0f)), 0.4f, 0.999f));
    lookAt(scene, {0.1f, 0.0f, 0.2f}, {0.0f, 1.0f, 0.0f}, 1.5f);
    expectFinite(device_, scene, true);
}

/// S13: texels, normals and coordinates that are legal but extreme.
TEST_F(Finite, ExtremeValues) {
    Scene scene;
    Material material;
    material.roughness = 0.0f;
    Mesh mesh = floorQuad(addMaterial(scene, material), 1e15f);
    mesh.normals = {{1, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
    addMesh(scene, std::move(mesh));
    scene.environment = environmentOf(8, 4, [](glm::dvec3 d) { return d.y > 0.5 ? 1e30 : 1e-30; });
    lookAt(scene, {0.0f, 1.0f, 0.0f}, {1.0f, 0.9f, 0.0f}, 0.8f);
    const FilmImage film = renderFilm(device_, scene, smallImage(16, 32, 4));
    EXPECT_EQ(film.nonFinitePixels, 0u);
}

}  // namespace
}  // namespace raylab::support
