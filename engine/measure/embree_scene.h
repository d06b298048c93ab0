#pragma once

#if RAYLAB_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>

#include "engine/measure/ray_bench.h"

namespace raylab {

struct ReleaseEmbree {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};

/// A committed scene of one mesh, whose primitives are the triangles in their order.
struct EmbreeScene {
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseEmbree> device;
    std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseEmbree> scene;
};

/// `filter`: asked of each hit with `user` as the geometry's pointer, which must outlive the scene; nullptr: none.
/// Throws Error where Embree does not start.
EmbreeScene makeEmbreeScene(const WorldTriangles& world, RTCSceneFlags flags, RTCFilterFunctionN filter = nullptr,
                            void* user = nullptr);

/// How a scene is asked: Embree 3 takes a context, Embree 4 arguments.
class EmbreeQuery {
public:
    EmbreeQuery(const EmbreeScene& embree, bool coherent) : scene_(embree.scene.get()) {
#if RAYLAB_EMBREE == 4
        rtcInitIntersectArguments(&intersect_);
        rtcInitOccludedArguments(&occluded_);
        intersect_.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
        occluded_.flags = intersect_.flags;
#else
        rtcInitIntersectContext(&context_);
        context_.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
#endif
    }

#if RAYLAB_EMBREE == 4
    void closest(RTCRayHit& ray) { rtcIntersect1(scene_, &ray, &intersect_); }
    void closest(const int* valid, RTCRayHit8& rays) { rtcIntersect8(valid, scene_, &rays, &intersect_); }
    void closest(const int* valid, RTCRayHit16& rays) { rtcIntersect16(valid, scene_, &rays, &intersect_); }
    void occluded(RTCRay& ray) { rtcOccluded1(scene_, &ray, &occluded_); }
    void occluded(const int* valid, RTCRay8& rays) { rtcOccluded8(valid, scene_, &rays, &occluded_); }
    void occluded(const int* valid, RTCRay16& rays) { rtcOccluded16(valid, scene_, &rays, &occluded_); }
#else
    void closest(RTCRayHit& ray) { rtcIntersect1(scene_, &context_, &ray); }
    void closest(const int* valid, RTCRayHit8& rays) { rtcIntersect8(valid, scene_, &context_, &rays); }
    void closest(const int* valid, RTCRayHit16& rays) { rtcIntersect16(valid, scene_, &context_, &rays); }
    void occluded(RTCRay& ray) { rtcOccluded1(scene_, &context_, &ray); }
    void occluded(const int* valid, RTCRay8& rays) { rtcOccluded8(valid, scene_, &context_, &rays); }
    void occluded(const int* valid, RTCRay16& rays) { rtcOccluded16(valid, scene_, &context_, &rays); }
#endif

private:
    RTCScene scene_;
#if RAYLAB_EMBREE == 4
    RTCIntersectArguments intersect_;
    RTCOccludedArguments occluded_;
#else
    RTCIntersectContext context_;
#endif
};

/// A ray as Embree takes it, without a hit. `id` reaches filters.
RTCRayHit embreeRay(const shared::RayData& data, uint32_t id);

}  // namespace raylab
