#include "engine/measure/embree_peer.h"

#if RAYLAB_EMBREE
#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "engine/core/error.h"
#include "engine/core/stopwatch.h"

namespace raylab {
namespace {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// A committed scene of one mesh.
struct EmbreeScene {
    DeviceHandle device;
    SceneHandle scene;
};

std::shared_ptr<EmbreeScene> makeScene(const WorldTriangles& world, RTCSceneFlags flags) {
    auto embree = std::make_shared<EmbreeScene>();
    embree->device.reset(rtcNewDevice(nullptr));
    if (!embree->device) throw Error("Embree does not start; use --no-peers", ExitCode::internalError);
    embree->scene.reset(rtcNewScene(embree->device.get()));
    rtcSetSceneFlags(embree->scene.get(), flags);
    const RTCGeometry geometry = rtcNewGeometry(embree->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                             world.positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                            world.triangles.size());
    std::copy(world.positions.begin(), world.positions.end(), static_cast<glm::vec3*>(vertices));
    std::copy(world.triangles.begin(), world.triangles.end(), static_cast<glm::uvec3*>(indices));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree->scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree->scene.get());
    return embree;
}

RTCIntersectContext makeContext(bool coherent) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

bool traceOne(RTCScene scene, const shared::RayData& data, bool anyHit) {
    RTCIntersectContext context = makeContext(false);
    RTCRayHit query{};
    query.ray = {data.origin.x,
                 data.origin.y,
                 data.origin.z,
                 data.tMin,
                 data.direction.x,
                 data.direction.y,
                 data.direction.z,
                 0.0f,
                 data.tMax,
                 ~0u,
                 0,
                 0};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    if (!anyHit) {
        rtcIntersect1(scene, &context, &query);
        return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    rtcOccluded1(scene, &context, &query.ray);
    return std::isinf(query.ray.tfar);
}

template <class Ray>
void setLane(Ray& ray, size_t lane, const shared::RayData& data) {
    ray.org_x[lane] = data.origin.x;
    ray.org_y[lane] = data.origin.y;
    ray.org_z[lane] = data.origin.z;
    ray.tnear[lane] = data.tMin;
    ray.dir_x[lane] = data.direction.x;
    ray.dir_y[lane] = data.direction.y;
    ray.dir_z[lane] = data.direction.z;
    ray.time[lane] = 0.0f;
    ray.tfar[lane] = data.tMax;
    ray.mask[lane] = ~0u;
    ray.id[lane] = 0;
    ray.flags[lane] = 0;
}

/// Packets of `width` rays in their order.
template <size_t width, class RayHit, class Intersect, class Occluded>
size_t tracePackets(std::span<const shared::RayData> rays, const RayKind& kind, const Intersect& intersect,
                    const Occluded& occluded) {
    size_t hits = 0;
    RTCIntersectContext context = makeContext(kind.coherent);
    for (size_t first = 0; first < rays.size(); first += width) {
        const size_t count = std::min(width, rays.size() - first);
        RayHit query;
        alignas(64) int valid[width];
        for (size_t lane = 0; lane < width; ++lane) {
            valid[lane] = lane < count ? -1 : 0;
            setLane(query.ray, lane, rays[first + std::min(lane, count - 1)]);
            query.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
            query.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
        }
        if (kind.anyHit)
            occluded(valid, &context, query.ray);
        else
            intersect(valid, &context, query);
        for (size_t lane = 0; lane < count; ++lane)
            hits += kind.anyHit ? std::isinf(query.ray.tfar[lane]) : query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

size_t traceRange(RTCScene scene, std::span<const shared::RayData> rays, const RayKind& kind, int width) {
    if (width == 8)
        return tracePackets<8, RTCRayHit8>(
            rays, kind,
            [&](const int* valid, auto* context, auto& query) { rtcIntersect8(valid, scene, context, &query); },
            [&](const int* valid, auto* context, auto& ray) { rtcOccluded8(valid, scene, context, &ray); });
    if (width == 16)
        return tracePackets<16, RTCRayHit16>(
            rays, kind,
            [&](const int* valid, auto* context, auto& query) { rtcIntersect16(valid, scene, context, &query); },
            [&](const int* valid, auto* context, auto& ray) { rtcOccluded16(valid, scene, context, &ray); });
    size_t hits = 0;
    for (const shared::RayData& ray : rays) hits += traceOne(scene, ray, kind.anyHit) ? 1 : 0;
    return hits;
}

class EmbreePeer : public BenchSubject {
public:
    EmbreePeer(std::shared_ptr<EmbreeScene> scene, int width, std::string name)
        : scene_(std::move(scene)), width_(width), name_(std::move(name)) {}
    SubjectLabel label() const override { return {name_, "", "", "", ""}; }
    TracedRays trace(const RaySet& set) override {
        std::atomic<size_t> hits{0};
        const Stopwatch watch;
        tbb::parallel_for(tbb::blocked_range<size_t>(0, set.rays.size(), 1024), [&](const auto& range) {
            hits += traceRange(scene_->scene.get(), std::span(set.rays).subspan(range.begin(), range.size()), set.kind,
                               width_);
        });
        return {watch.seconds(), hits};
    }
    std::optional<RayCounters> count(const RaySet&) override { return std::nullopt; }

private:
    std::shared_ptr<EmbreeScene> scene_;
    int width_;
    std::string name_;
};

}  // namespace

std::vector<std::unique_ptr<BenchSubject>> makeEmbreePeers(const WorldTriangles& world) {
    const std::shared_ptr<EmbreeScene> standard = makeScene(world, RTC_SCENE_FLAG_NONE);
    const std::shared_ptr<EmbreeScene> robust = makeScene(world, RTC_SCENE_FLAG_ROBUST);
    std::vector<std::unique_ptr<BenchSubject>> peers;
    peers.push_back(std::make_unique<EmbreePeer>(standard, 1, "embree1"));
    peers.push_back(std::make_unique<EmbreePeer>(robust, 1, "embree1-robust"));
    peers.push_back(std::make_unique<EmbreePeer>(standard, 8, "embree8"));
    peers.push_back(std::make_unique<EmbreePeer>(standard, 16, "embree16"));
    return peers;
}

}  // namespace raylab

#else

namespace raylab {

std::vector<std::unique_ptr<BenchSubject>> makeEmbreePeers(const WorldTriangles&) { return {}; }

}  // namespace raylab

#endif
