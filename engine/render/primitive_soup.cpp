#include "engine/render/primitive_soup.h"

#include <glm/gtc/matrix_transform.hpp>
#include <span>

#include "engine/accel/build_input.h"
#include "engine/accel/triangle_bounds.h"
#include "engine/render/opacity_map.h"
#include "engine/scene/quadric.h"

namespace raylab {
namespace {

/// `opacity`: of the mesh's triangles.
void appendMesh(const Mesh& mesh, std::span<const uint32_t> opacity, const glm::mat4& matrix, uint32_t instance,
                PrimitiveSoup& soup) {
    const auto base = static_cast<uint32_t>(soup.positions.size());
    const bool identity = matrix == glm::mat4(1.0f);
    for (const glm::vec3& p : mesh.positions)
        soup.positions.push_back(identity ? p : glm::vec3(matrix * glm::vec4(p, 1.0f)));
    for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3 t = mesh.triangles[i] + base;
        soup.triangles.push_back(t);
        soup.records.push_back({soup.positions[t.x], instance, soup.positions[t.y], i, soup.positions[t.z], opacity[i]});
    }
}

/// Rows of the matrix that takes a point in the space of the tree to the quadric's canonical space.
shared::TraceQuadric traceQuadric(const Quadric& quadric, const glm::mat4& matrix) {
    const glm::dmat4 scale = glm::scale(glm::dmat4(1.0), glm::dvec3(quadric.radii));
    const glm::mat4 rows(glm::transpose(glm::inverse(glm::dmat4(matrix) * scale)));
    const QuadricForm form = quadricForm(quadric.kind);
    shared::TraceQuadric record{};
    record.toCanonical0 = rows[0];
    record.toCanonical1 = rows[1];
    record.toCanonical2 = rows[2];
    record.zz = form.zz;
    record.z = form.z;
    record.constant = form.constant;
    record.clipLow = quadric.clipLow / quadric.radii.z;
    record.clipHigh = quadric.clipHigh / quadric.radii.z;
    record.isEllipsoid = quadric.kind == QuadricKind::ellipsoid ? 1 : 0;
    return record;
}

void appendQuadrics(const Scene& scene, const Mesh& mesh, const glm::mat4& matrix, uint32_t instance,
                    PrimitiveSoup& soup) {
    const bool tested = !mesh.quadrics.empty() && scene.materials[mesh.material].alphaMode != AlphaMode::opaque;
    for (uint32_t i = 0; i < mesh.quadrics.size(); ++i) {
        shared::TraceTriangle record{};
        record.instance = instance | shared::kSlotIsQuadric;
        record.primitive = i;
        record.opacity = tested ? 0 : shared::kAllOpaque;
        soup.quadricRecords.push_back(record);
        soup.quadrics.push_back(traceQuadric(mesh.quadrics[i], matrix));
        soup.quadricBounds.push_back(widened(quadricBounds(mesh.quadrics[i], matrix)));
    }
}

}  // namespace

Aabb widened(const Bounds& box) {
    if (box.lo.x > box.hi.x) return {};
    const glm::vec3 slack = glm::max(glm::abs(box.lo), glm::abs(box.hi)) * 1e-5f;
    return {box.lo - slack, box.hi + slack};
}

PrimitiveSoup mergedSoup(const Scene& scene, const TreePlan& plan) {
    PrimitiveSoup soup;
    std::vector<std::vector<uint32_t>> opacity(scene.meshes.size());  // made once, however often the mesh is shown
    for (uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (plan.ownTree[instance.mesh]) continue;
        if (opacity[instance.mesh].empty()) opacity[instance.mesh] = opacityMaps(scene, mesh);
        appendMesh(mesh, opacity[instance.mesh], instance.objectToWorld, i, soup);
        appendQuadrics(scene, mesh, instance.objectToWorld, i, soup);
    }
    return soup;
}

PrimitiveSoup meshSoup(const Scene& scene, uint32_t mesh) {
    PrimitiveSoup soup;
    appendMesh(scene.meshes[mesh], opacityMaps(scene, scene.meshes[mesh]), glm::mat4(1.0f), shared::kInheritInstance, soup);
    appendQuadrics(scene, scene.meshes[mesh], glm::mat4(1.0f), shared::kInheritInstance, soup);
    return soup;
}

SoupInput::SoupInput(const PrimitiveSoup& soup)
    : bounds(triangleBounds(soup.positions, soup.triangles)), triangles(soup.triangles) {
    bounds.insert(bounds.end(), soup.quadricBounds.begin(), soup.quadricBounds.end());
    triangles.resize(bounds.size(), kBoxAlone);
}

}  // namespace raylab
