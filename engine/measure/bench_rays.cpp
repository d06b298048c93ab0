#include "engine/measure/bench_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "engine/render/camera.h"
#include "engine/scene/bounds.h"
#include "engine/scene/quadric.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

constexpr float kFar = 3e38f;
constexpr int kBounces = 4;

/// A point of a surface that a ray has met, and the side it came from.
struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 normal;    ///< unit, geometric, towards where the ray came from
    glm::vec3 incoming;  ///< unit direction of that ray
    uint32_t pixel;
};

/// Uniform in [0, 1): a hash of where the number is used (PCG output permutation; Jarzynski, Olano, JCGT 9(3), 2020).
float randomFloat(uint32_t seed, uint32_t pixel, uint32_t dimension) {
    uint32_t state = pixel * 747796405u + (seed * 9781u + dimension) * 2891336453u + 1u;
    for (int round = 0; round < 2; ++round) {
        state = state * 747796405u + 2891336453u;
        const uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
        state = (word >> 22) ^ word;
    }
    return static_cast<float>(state >> 8) * 0x1p-24f;
}

glm::vec3 cosineDirection(const glm::vec3& normal, float u, float v) {
    const float z = 1.0f - 2.0f * u;
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const float phi = glm::two_pi<float>() * v;
    const glm::vec3 direction = normal + glm::vec3(r * std::cos(phi), r * std::sin(phi), z);
    const float length = glm::length(direction);
    return length > 1e-4f ? direction / length : normal;
}

shared::RayData rayFrom(const glm::vec3& origin, const glm::vec3& direction, float tMax) {
    return {origin, 0.0f, direction, tMax};
}

/// Away from the surface by some units in the last place of the coordinates: benchmarks need no more than that.
glm::vec3 offsetOrigin(const SurfacePoint& point) {
    const glm::vec3 size = glm::abs(point.position);
    return point.position + point.normal * (64.0f * 0x1p-23f * std::max({size.x, size.y, size.z}));
}

/// The order of the render kernels: tiles row by row, in each blocks of 4 x 2 pixels.
std::vector<glm::uvec2> pixelOrder(uint32_t width, uint32_t height) {
    std::vector<glm::uvec2> pixels;
    for (uint32_t tileY = 0; tileY < height; tileY += shared::kTileSize)
        for (uint32_t tileX = 0; tileX < width; tileX += shared::kTileSize)
            for (uint32_t lane = 0; lane < shared::kWorkgroupSize; ++lane) {
                const uint32_t block = lane >> 3;
                const glm::uvec2 pixel(tileX + (block & 1u) * 4u + (lane & 3u),
                                       tileY + (block >> 1) * 2u + ((lane >> 2) & 1u));
                if (pixel.x < width && pixel.y < height) pixels.push_back(pixel);
            }
    return pixels;
}

std::vector<shared::RayData> primaryRays(const BenchView& view) {
    shared::FrameParams frame{};
    writeCamera(view.camera, view.width, view.height, frame);
    std::vector<shared::RayData> rays;
    for (const glm::uvec2 pixel : pixelOrder(view.width, view.height)) {
        const glm::vec2 ndc = (glm::vec2(pixel) + 0.5f) / glm::vec2(view.width, view.height) * 2.0f - 1.0f;
        const glm::vec3 d = frame.cameraForward + ndc.x * frame.cameraRight - ndc.y * frame.cameraUp;
        rays.push_back(rayFrom(frame.cameraPosition, glm::normalize(d), kFar));
    }
    return rays;
}

glm::vec3 geometricNormal(const Scene& scene, const shared::HitData& hit, const glm::vec3& point) {
    const Instance& instance = scene.instances[hit.instance];
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (!mesh.quadrics.empty()) {
        const glm::dmat4 toObject = glm::inverse(glm::dmat4(instance.objectToWorld));
        const glm::dvec3 local(toObject * glm::dvec4(point, 1.0));
        return glm::vec3(glm::normalize(glm::transpose(glm::dmat3(toObject)) *
                                        quadricGradient(mesh.quadrics[hit.primitive], local)));
    }
    const glm::uvec3 t = mesh.triangles[hit.primitive];
    const auto world = [&](uint32_t v) {
        return glm::dvec3(glm::dmat4(instance.objectToWorld) * glm::dvec4(mesh.positions[v], 1.0));
    };
    const glm::dvec3 p0 = world(t.x);
    return glm::vec3(glm::normalize(glm::cross(world(t.y) - p0, world(t.z) - p0)));
}

/// What the rays met; rays without a hit have no point. `pixels`: of each ray.
std::vector<SurfacePoint> surfacePoints(const Scene& scene, std::span<const shared::RayData> rays,
                                        std::span<const shared::HitData> hits, std::span<const uint32_t> pixels) {
    std::vector<SurfacePoint> points;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].t < 0.0f) continue;
        const glm::vec3 incoming = glm::normalize(rays[i].direction);
        const glm::vec3 point = rays[i].origin + hits[i].t * rays[i].direction;
        const glm::vec3 normal = geometricNormal(scene, hits[i], point);
        points.push_back({point, glm::dot(normal, incoming) > 0.0f ? -normal : normal, incoming, pixels[i]});
    }
    return points;
}

template <class MakeRay>
std::vector<shared::RayData> raysFrom(const std::vector<SurfacePoint>& points, const MakeRay& makeRay) {
    std::vector<shared::RayData> rays(points.size());
    tbb::parallel_for(size_t{0}, points.size(), [&](size_t i) { rays[i] = makeRay(points[i]); });
    return rays;
}

shared::RayData bounce(const SurfacePoint& point, uint32_t seed, uint32_t number) {
    const float u = randomFloat(seed, point.pixel, 2u * number);
    const float v = randomFloat(seed, point.pixel, 2u * number + 1u);
    return rayFrom(offsetOrigin(point), cosineDirection(point.normal, u, v), kFar);
}

shared::RayData shadowRay(const SurfacePoint& point, const BenchLight& light, uint32_t seed) {
    const glm::vec3 target = light.centre + glm::vec3((randomFloat(seed, point.pixel, 0) - 0.5f) * light.sizeX, 0.0f,
                                                      (randomFloat(seed, point.pixel, 1) - 0.5f) * light.sizeZ);
    const glm::vec3 origin = offsetOrigin(point);
    return rayFrom(origin, target - origin, 0.9999f);
}

std::vector<uint32_t> pixelsOf(const std::vector<SurfacePoint>& points) {
    std::vector<uint32_t> pixels;
    for (const SurfacePoint& point : points) pixels.push_back(point.pixel);
    return pixels;
}

}  // namespace

BenchLight defaultBenchLight(const Scene& scene) {
    const Bounds bounds = sceneBounds(scene);
    const glm::vec3 extent = bounds.hi - bounds.lo;
    const glm::vec3 centre = 0.5f * (bounds.lo + bounds.hi);
    return {{centre.x, bounds.hi.y - 0.01f * extent.y, centre.z}, 0.125f * extent.x, 0.125f * extent.z};
}

std::vector<PixelRays> makePathRays(HitSource& caster, const Scene& scene, const BenchView& view, int bounces) {
    const std::vector<glm::uvec2> order = pixelOrder(view.width, view.height);
    std::vector<uint32_t> places(order.size());  // in that order, which random numbers depend on
    for (uint32_t i = 0; i < places.size(); ++i) places[i] = i;
    std::vector<PixelRays> paths;
    std::vector<shared::RayData> rays = primaryRays(view);
    for (int number = 0;; ++number) {
        PixelRays& path = paths.emplace_back(PixelRays{rays, {}});
        for (const uint32_t place : places) path.pixels.push_back(order[place].y * view.width + order[place].x);
        if (number == bounces) return paths;
        const std::vector<SurfacePoint> points = surfacePoints(scene, rays, caster.closest(rays), places);
        rays = raysFrom(points,
                        [&](const SurfacePoint& p) { return bounce(p, view.seed, static_cast<uint32_t>(number + 1)); });
        places = pixelsOf(points);
    }
}

std::vector<RaySet> makeBenchRays(HitSource& caster, const Scene& scene, const BenchView& view) {
    const Bounds bounds = sceneBounds(scene);
    const float aoDistance = 0.1f * glm::length(bounds.hi - bounds.lo);
    const std::vector<shared::RayData> primary = primaryRays(view);
    std::vector<uint32_t> pixels(primary.size());
    for (uint32_t i = 0; i < pixels.size(); ++i) pixels[i] = i;
    const std::vector<SurfacePoint> first = surfacePoints(scene, primary, caster.closest(primary), pixels);
    std::vector<shared::RayData> diffuse, fourth;
    std::vector<SurfacePoint> points = first;
    for (int number = 1; number <= kBounces; ++number) {
        fourth = raysFrom(points,
                          [&](const SurfacePoint& p) { return bounce(p, view.seed, static_cast<uint32_t>(number)); });
        if (number == 1) diffuse = fourth;
        if (number < kBounces) points = surfacePoints(scene, fourth, caster.closest(fourth), pixelsOf(points));
    }
    const auto ambient = [&](const SurfacePoint& p) {
        shared::RayData ray = bounce(p, view.seed + 1, 0);
        ray.tMax = aoDistance;
        return ray;
    };
    const auto mirror = [&](const SurfacePoint& p) {
        return rayFrom(offsetOrigin(p), glm::reflect(p.incoming, p.normal), kFar);
    };
    return {{kRayKinds[0], primary},
            {kRayKinds[1], raysFrom(first, [&](const SurfacePoint& p) { return shadowRay(p, view.light, view.seed); })},
            {kRayKinds[2], raysFrom(first, ambient)},
            {kRayKinds[3], diffuse},
            {kRayKinds[4], fourth},
            {kRayKinds[5], raysFrom(first, mirror)}};
}

}  // namespace raylab
