#include "engine/measure/embree_caster.h"

#include "engine/core/error.h"

#if RAYLAB_EMBREE
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "engine/core/stopwatch.h"
#include "engine/measure/embree_scene.h"
#include "engine/measure/hit_oracle_surface.h"
#endif

namespace raylab {

#if RAYLAB_EMBREE

namespace {

/// What the filter decides alpha by.
struct AlphaRule {
    const Scene& scene;
    std::vector<glm::uvec2> ids;
    std::vector<std::optional<oracle::Placement>> placements;  ///< of instances

    bool accepts(uint32_t triangle, uint32_t key, glm::dvec2 barycentrics) const {
        oracle::Candidate candidate;
        candidate.instance = ids[triangle].x;
        candidate.primitive = ids[triangle].y;
        candidate.exact = true;
        candidate.barycentrics = barycentrics;
        const std::optional<oracle::Placement>& placement = placements[candidate.instance];
        if (placement) oracle::applyAlpha(scene, *placement, key, candidate);
        return placement && candidate.exact;
    }
};

void filterByAlpha(const RTCFilterFunctionNArguments* arguments) {
    const auto& rule = *static_cast<const AlphaRule*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] != -1) continue;
        const glm::dvec2 barycentrics(static_cast<double>(RTCHitN_u(arguments->hit, arguments->N, i)),
                                      static_cast<double>(RTCHitN_v(arguments->hit, arguments->N, i)));
        if (!rule.accepts(RTCHitN_primID(arguments->hit, arguments->N, i), RTCRayN_id(arguments->ray, arguments->N, i),
                          barycentrics))
            arguments->valid[i] = 0;
    }
}

bool hasAlpha(const Scene& scene) {
    return std::ranges::any_of(scene.materials,
                               [](const Material& material) { return material.alphaMode != AlphaMode::opaque; });
}

class EmbreeCaster : public HitSource {
public:
    EmbreeCaster(const Scene& scene, bool robust) : rule_{scene, {}, {}} {
        WorldTriangles world = worldTriangles(scene);
        for (uint32_t i = 0; i < scene.instances.size(); ++i)
            rule_.placements.push_back(oracle::Placement::make(scene, i));
        embree_ = makeEmbreeScene(world, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE,
                                  hasAlpha(scene) ? filterByAlpha : nullptr, &rule_);
        rule_.ids = std::move(world.ids);
    }

    std::vector<shared::HitData> closest(std::span<const shared::RayData> rays) override {
        return trace(rays, [&](EmbreeQuery& embree, RTCRayHit& query) {
            embree.closest(query);
            shared::HitData hit{.t = -1.0f};
            if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
            const glm::uvec2 id = rule_.ids[query.hit.primID];
            hit = {query.ray.tfar, query.hit.u, query.hit.v, id.x, id.y};
            return hit;
        });
    }
    std::vector<shared::HitData> occluded(std::span<const shared::RayData> rays) override {
        return trace(rays, [](EmbreeQuery& embree, RTCRayHit& query) {
            embree.occluded(query.ray);
            return shared::HitData{.t = std::isinf(query.ray.tfar) && query.ray.tfar < 0.0f ? 1.0f : -1.0f};
        });
    }
    double traceSeconds() const override { return seconds_; }

private:
    template <class Ask>
    std::vector<shared::HitData> trace(std::span<const shared::RayData> rays, const Ask& ask) {
        std::vector<shared::HitData> hits(rays.size());
        const Stopwatch watch;
        tbb::parallel_for(tbb::blocked_range<size_t>(0, rays.size(), 1024), [&](const auto& range) {
            EmbreeQuery embree(embree_, false);
            for (size_t i = range.begin(); i < range.end(); ++i) {
                RTCRayHit query = embreeRay(rays[i], static_cast<uint32_t>(i));
                hits[i] = ask(embree, query);
            }
        });
        seconds_ = watch.seconds();
        return hits;
    }

    AlphaRule rule_;
    EmbreeScene embree_;
    double seconds_ = 0.0;
};

}  // namespace

bool hasEmbree() { return true; }

std::unique_ptr<HitSource> makeEmbreeCaster(const Scene& scene, bool robust) {
    if (std::ranges::any_of(scene.meshes, [](const Mesh& mesh) { return !mesh.quadrics.empty(); }))
        throw Error(scene.name + ": holds quadrics, which raylab does not give to Embree; compare with another tracer");
    return std::make_unique<EmbreeCaster>(scene, robust);
}

#else

bool hasEmbree() { return false; }

std::unique_ptr<HitSource> makeEmbreeCaster(const Scene&, bool) {
    throw Error("this raylab was built without Embree; install libembree-dev and build again");
}

#endif

}  // namespace raylab
