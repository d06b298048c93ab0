#include "engine/scene/bounds.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/scene/instance_motion.h"
#include "engine/scene/quadric.h"

namespace raylab {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kDefaultFovY = 0.7853982f;  // 45 degrees

Bounds merged(const Bounds& a, const Bounds& b) { return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)}; }

Bounds meshBounds(const Mesh& mesh, const glm::mat4& toWorld) {
    Bounds bounds{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
    for (const glm::vec3& position : mesh.positions) {
        const glm::vec3 world(toWorld * glm::vec4(position, 1.0f));
        bounds = merged(bounds, {world, world});
    }
    for (const Quadric& quadric : mesh.quadrics) {
        const Bounds box = quadricBounds(quadric, toWorld);
        if (box.lo.x <= box.hi.x) bounds = merged(bounds, box);
    }
    return bounds;
}

/// Over all of its motion: points move in straight lines between its ends.
Bounds instanceBounds(const Scene& scene, const Instance& instance) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const Bounds bounds = meshBounds(mesh, instance.objectToWorld);
    return moves(instance) ? merged(bounds, meshBounds(mesh, *instance.endToWorld)) : bounds;
}

}  // namespace

Bounds sceneBounds(const Scene& scene) {
    if (scene.instances.empty()) return {};
    using Range = tbb::blocked_range<size_t>;
    const Bounds nothing{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
    const auto ofRange = [&scene](const Range& range, Bounds bounds) {
        for (size_t i = range.begin(); i < range.end(); ++i)
            bounds = merged(bounds, instanceBounds(scene, scene.instances[i]));
        return bounds;
    };
    const Bounds bounds = tbb::parallel_reduce(Range(0, scene.instances.size()), nothing, ofRange, merged);
    return bounds.lo.x <= bounds.hi.x ? bounds : Bounds{};
}

Camera defaultCamera(const Scene& scene) {
    const Bounds bounds = sceneBounds(scene);
    const float radius = std::max(0.5f * glm::length(bounds.hi - bounds.lo), 1e-6f);
    Camera camera;
    camera.name = "default";
    camera.fovYRadians = kDefaultFovY;
    camera.target = 0.5f * (bounds.lo + bounds.hi);
    // The sphere around the box touches the edges of the view.
    const float distance = radius / std::sin(0.5f * kDefaultFovY);
    camera.position = camera.target + distance * glm::normalize(glm::vec3(0.6f, 0.45f, 1.0f));
    return camera;
}

PrimitiveCount triangleCount(const Scene& scene) {
    PrimitiveCount count;
    for (const Mesh& mesh : scene.meshes) count.stored += mesh.triangles.size();
    for (const Instance& instance : scene.instances) count.instanced += scene.meshes[instance.mesh].triangles.size();
    return count;
}

PrimitiveCount quadricCount(const Scene& scene) {
    PrimitiveCount count;
    for (const Mesh& mesh : scene.meshes) count.stored += mesh.quadrics.size();
    for (const Instance& instance : scene.instances) count.instanced += scene.meshes[instance.mesh].quadrics.size();
    return count;
}

}  // namespace raylab
