#include "engine/measure/embree_peer.h"

#if RAYLAB_EMBREE
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

#include "engine/core/stopwatch.h"
#include "engine/measure/embree_scene.h"

namespace raylab {
namespace {

bool traceOne(EmbreeQuery& embree, const shared::RayData& data, bool anyHit) {
    RTCRayHit query = embreeRay(data, 0);
    if (!anyHit) {
        embree.closest(query);
        return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    embree.occluded(query.ray);
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
template <size_t width, class RayHit>
size_t tracePackets(EmbreeQuery& embree, std::span<const shared::RayData> rays, bool anyHit) {
    size_t hits = 0;
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
        if (anyHit)
            embree.occluded(valid, query.ray);
        else
            embree.closest(valid, query);
        for (size_t lane = 0; lane < count; ++lane)
            hits += anyHit ? std::isinf(query.ray.tfar[lane]) : query.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

size_t traceRange(const EmbreeScene& scene, std::span<const shared::RayData> rays, const RayKind& kind, int width) {
    EmbreeQuery embree(scene, width > 1 && kind.coherent);
    if (width == 8) return tracePackets<8, RTCRayHit8>(embree, rays, kind.anyHit);
    if (width == 16) return tracePackets<16, RTCRayHit16>(embree, rays, kind.anyHit);
    size_t hits = 0;
    for (const shared::RayData& ray : rays) hits += traceOne(embree, ray, kind.anyHit) ? 1 : 0;
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
            hits += traceRange(*scene_, std::span(set.rays).subspan(range.begin(), range.size()), set.kind, width_);
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
    const auto standard = std::make_shared<EmbreeScene>(makeEmbreeScene(world, RTC_SCENE_FLAG_NONE));
    const auto robust = std::make_shared<EmbreeScene>(makeEmbreeScene(world, RTC_SCENE_FLAG_ROBUST));
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
