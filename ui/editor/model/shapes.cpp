#include "ui/editor/model/shapes.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "engine/core/error.h"
#include "ui/editor/model/edit_instances.h"

namespace raylab::editor {
namespace {

/// Of the sphere's mesh: edges stray 0.1 % from the true sphere, its silhouette shows no corners in a window.
constexpr uint32_t kSlices = 96, kStacks = 48;

/// A square with its front towards `normal`: a face of the box, or the plane.
void addSquare(Mesh& mesh, glm::vec3 center, glm::vec3 u, glm::vec3 v) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
        mesh.positions.push_back(center + u * (2.0f * corner.x - 1.0f) + v * (2.0f * corner.y - 1.0f));
        mesh.uvs.emplace_back(corner.x, 1.0f - corner.y);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
}

void addBox(Mesh& mesh) {
    const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    addSquare(mesh, x, -z, y);
    addSquare(mesh, -x, z, y);
    addSquare(mesh, y, x, -z);
    addSquare(mesh, -y, x, z);
    addSquare(mesh, z, x, y);
    addSquare(mesh, -z, -x, y);
}

/// A ring has its first point twice, for the seam of the texture; a pole has a point for each triangle.
void addSphere(Mesh& mesh) {
    std::vector<uint32_t> rowStart;
    for (uint32_t j = 0; j <= kStacks; ++j) {
        const bool isPole = j == 0 || j == kStacks;
        rowStart.push_back(static_cast<uint32_t>(mesh.positions.size()));
        for (uint32_t i = 0; i < kSlices + (isPole ? 0 : 1); ++i) {
            const glm::dvec2 uv((i + (isPole ? 0.5 : 0.0)) / kSlices, static_cast<double>(j) / kStacks);
            const double phi = glm::two_pi<double>() * uv.x, theta = glm::pi<double>() * uv.y;
            const double ring = isPole ? 0.0 : std::sin(theta);
            const glm::vec3 normal(glm::dvec3(ring * std::cos(phi), std::cos(theta), -ring * std::sin(phi)));
            mesh.positions.push_back(normal);
            mesh.normals.push_back(normal);
            mesh.uvs.emplace_back(uv);
        }
    }
    for (uint32_t j = 0; j < kStacks; ++j)
        for (uint32_t i = 0; i < kSlices; ++i) {
            const uint32_t a = rowStart[j] + i, b = rowStart[j + 1] + i;
            if (j > 0) mesh.triangles.emplace_back(a, j + 1 < kStacks ? b + 1 : b, a + 1);
            if (j + 1 < kStacks) mesh.triangles.emplace_back(a, b, b + 1);
        }
}

Quadric quadricOf(Shape shape) {
    switch (shape) {
        case Shape::cylinder:
            return {QuadricKind::cylinder, glm::vec3(1.0f), -1.0f, 1.0f};
        case Shape::cone:
            return {QuadricKind::cone, glm::vec3(1.0f), -1.0f, 0.0f};
        case Shape::hyperboloid:
            return {QuadricKind::hyperboloid, glm::vec3(0.7071068f, 0.7071068f, 1.0f), -1.0f, 1.0f};
        case Shape::paraboloid:
            return {QuadricKind::paraboloid, glm::vec3(1.0f), 0.0f, 1.0f};
        default:
            return {QuadricKind::ellipsoid, glm::vec3(1.0f), -1.0f, 1.0f};
    }
}

bool isQuadric(Shape shape) { return shape != Shape::plane && shape != Shape::box && shape != Shape::sphere; }

/// Of the selection, or a grey one that is added.
uint32_t materialFor(EditState& state, const std::string& name) {
    if (state.selection.material) return *state.selection.material;
    state.scene.materials.push_back({.name = name, .baseColor = glm::vec3(0.8f), .roughness = 0.5f});
    return static_cast<uint32_t>(state.scene.materials.size() - 1);
}

}  // namespace

const char* shapeName(Shape shape) {
    constexpr const char* kNames[] = {"plane",    "box",  "sphere",      "ellipsoid",
                                      "cylinder", "cone", "hyperboloid", "paraboloid"};
    return kNames[static_cast<size_t>(shape)];
}

Mesh makeShape(Shape shape) {
    Mesh mesh{.name = shapeName(shape)};
    if (shape == Shape::plane) addSquare(mesh, glm::vec3(0.0f), glm::vec3(1, 0, 0), glm::vec3(0, 0, -1));
    if (shape == Shape::box) addBox(mesh);
    if (shape == Shape::sphere) addSphere(mesh);
    if (isQuadric(shape)) mesh.quadrics.push_back(quadricOf(shape));
    return mesh;
}

Edit addShape(Shape shape, glm::vec3 position, float radius) {
    if (!(radius > 0.0f)) throw Error(std::string("a ") + shapeName(shape) + " needs a radius above 0");
    return {std::string("Add ") + shapeName(shape), [shape, position, radius](EditState& state) {
                Mesh mesh = makeShape(shape);
                mesh.material = materialFor(state, mesh.name);
                Instance instance{.name = mesh.name, .mesh = static_cast<uint32_t>(state.scene.meshes.size())};
                instance.objectToWorld = glm::scale(glm::translate(glm::mat4(1.0f), position), glm::vec3(radius));
                if (isQuadric(shape))
                    instance.objectToWorld =
                        glm::rotate(instance.objectToWorld, -glm::half_pi<float>(), glm::vec3(1, 0, 0));
                state.scene.meshes.push_back(std::move(mesh));
                const uint32_t index = insertInstance(state, std::move(instance));
                state.selection = {};
                state.selection.instances = {index};
            }};
}

}  // namespace raylab::editor
