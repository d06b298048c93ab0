#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "engine/core/error.h"
#include "engine/render/gpu_data.h"
#include "engine/scene/instance_motion.h"
#include "engine/scene/quadric.h"

namespace raylab {
namespace {

glm::vec2 octahedral(glm::vec3 n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    glm::vec2 e = sum > 0.0f ? glm::vec2(n.x, n.y) / sum : glm::vec2(0.0f);
    if (n.z < 0.0f)
        e = (1.0f - glm::abs(glm::vec2(e.y, e.x))) * glm::vec2(e.x >= 0.0f ? 1.0f : -1.0f, e.y >= 0.0f ? 1.0f : -1.0f);
    return e;
}

uint32_t snorm16(float value) {
    const auto rounded = static_cast<int32_t>(std::lround(std::clamp(value, -1.0f, 1.0f) * 32767.0f));
    return static_cast<uint32_t>(rounded) & 0xffffu;
}

shared::VertexData packVertex(const Mesh& mesh, size_t i) {
    shared::VertexData vertex{};
    vertex.position = mesh.positions[i];
    if (!mesh.normals.empty()) vertex.normal = encodeNormal(mesh.normals[i]);
    if (!mesh.uvs.empty()) {
        vertex.u = mesh.uvs[i].x;
        vertex.v = mesh.uvs[i].y;
    }
    if (!mesh.tangents.empty()) vertex.tangent = encodeTangent(mesh.tangents[i]);
    return vertex;
}

shared::QuadricData packQuadric(const Quadric& quadric) {
    const QuadricForm form = quadricForm(quadric.kind);
    shared::QuadricData data{};
    data.radii = quadric.radii;
    data.zz = form.zz;
    data.z = form.z;
    data.constant = form.constant;
    data.height = (quadric.clipHigh - quadric.clipLow) / quadric.radii.z;
    data.isEllipsoid = quadric.kind == QuadricKind::ellipsoid ? 1 : 0;
    return data;
}

struct MeshPlace {
    uint32_t firstVertex = 0;
    uint32_t firstTriangle = 0;
    uint32_t firstQuadric = 0;
};

std::vector<MeshPlace> placeMeshes(const Scene& scene, MeshPlace& end) {
    std::vector<MeshPlace> places;
    uint64_t vertices = 0, triangles = 0, quadrics = 0;
    for (const Mesh& mesh : scene.meshes) {
        places.push_back({static_cast<uint32_t>(vertices), static_cast<uint32_t>(triangles),
                          static_cast<uint32_t>(quadrics)});
        vertices += mesh.positions.size();
        triangles += mesh.triangles.size();
        quadrics += mesh.quadrics.size();
        if (std::max({vertices, triangles, quadrics}) > UINT32_MAX / 2)
            throw Error(scene.name + ": more than two thousand million vertices or primitives; split the scene");
    }
    end = {static_cast<uint32_t>(vertices), static_cast<uint32_t>(triangles), static_cast<uint32_t>(quadrics)};
    return places;
}

shared::InstanceData packInstance(const Scene& scene, const Instance& instance, const MeshPlace& place) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const glm::mat4 rows = glm::transpose(instance.objectToWorld);
    shared::InstanceData data{};
    data.objectToWorld0 = rows[0];
    data.objectToWorld1 = rows[1];
    data.objectToWorld2 = rows[2];
    data.firstPrimitive = mesh.quadrics.empty() ? place.firstTriangle : place.firstQuadric;
    if (!mesh.quadrics.empty()) data.flags |= shared::kInstanceQuadric;
    data.material = mesh.material;
    if (!mesh.normals.empty()) data.flags |= shared::kInstanceSmooth;
    if (glm::determinant(glm::dmat3(instance.objectToWorld)) < 0.0) data.flags |= shared::kInstanceMirrored;
    if (moves(instance)) data.flags |= shared::kInstanceMoves;
    return data;
}

std::vector<shared::InstanceData> instancesAt(const Scene& scene, const std::vector<MeshPlace>& places) {
    std::vector<shared::InstanceData> instances;
    for (const Instance& instance : scene.instances)
        instances.push_back(packInstance(scene, instance, places[instance.mesh]));
    return instances;
}

}  // namespace

std::vector<shared::MotionData> packMotion(const Scene& scene) {
    std::vector<shared::MotionData> packed;
    if (std::ranges::none_of(scene.instances, moves)) return packed;
    for (const Instance& instance : scene.instances) {
        const glm::mat4 rows = glm::transpose(instance.endToWorld.value_or(instance.objectToWorld));
        packed.push_back({rows[0], rows[1], rows[2]});
    }
    return packed;
}

uint32_t encodeNormal(glm::vec3 unit) {
    const glm::vec2 e = octahedral(unit);
    return snorm16(e.x) | snorm16(e.y) << 16;
}

uint32_t encodeTangent(glm::vec4 tangent) {
    return (encodeNormal(glm::vec3(tangent)) & ~1u) | (tangent.w >= 0.0f ? 1u : 0u);
}

GeometryData packGeometry(const Scene& scene) {
    GeometryData data;
    MeshPlace end;
    const std::vector<MeshPlace> places = placeMeshes(scene, end);
    data.vertices.resize(end.firstVertex);
    data.triangles.resize(end.firstTriangle);
    data.quadrics.resize(end.firstQuadric);
    tbb::parallel_for(size_t{0}, scene.meshes.size(), [&](size_t m) {
        const Mesh& mesh = scene.meshes[m];
        const MeshPlace place = places[m];
        for (size_t i = 0; i < mesh.positions.size(); ++i) data.vertices[place.firstVertex + i] = packVertex(mesh, i);
        for (size_t i = 0; i < mesh.triangles.size(); ++i) {
            const glm::uvec3 t = mesh.triangles[i] + place.firstVertex;
            data.triangles[place.firstTriangle + i] = {t.x, t.y, t.z, 0};
        }
        for (size_t i = 0; i < mesh.quadrics.size(); ++i)
            data.quadrics[place.firstQuadric + i] = packQuadric(mesh.quadrics[i]);
    });
    data.instances = instancesAt(scene, places);
    return data;
}

std::vector<shared::InstanceData> packInstances(const Scene& scene) {
    MeshPlace end;
    return instancesAt(scene, placeMeshes(scene, end));
}

}  // namespace raylab
