#if RAYLAB_EMBREE
#include "engine/measure/embree_scene.h"

#include <algorithm>

#include "engine/core/error.h"

namespace raylab {

EmbreeScene makeEmbreeScene(const WorldTriangles& world, RTCSceneFlags flags, RTCFilterFunctionN filter, void* user) {
    EmbreeScene embree;
    embree.device.reset(rtcNewDevice(nullptr));
    if (!embree.device) throw Error("Embree does not start", ExitCode::internalError);
    embree.scene.reset(rtcNewScene(embree.device.get()));
    rtcSetSceneFlags(embree.scene.get(), flags);
    const RTCGeometry geometry = rtcNewGeometry(embree.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3),
                                             world.positions.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3),
                                            world.triangles.size());
    std::copy(world.positions.begin(), world.positions.end(), static_cast<glm::vec3*>(vertices));
    std::copy(world.triangles.begin(), world.triangles.end(), static_cast<glm::uvec3*>(indices));
    if (filter != nullptr) {
        rtcSetGeometryUserData(geometry, user);
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
        rtcSetGeometryOccludedFilterFunction(geometry, filter);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree.scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree.scene.get());
    return embree;
}

RTCRayHit embreeRay(const shared::RayData& data, uint32_t id) {
    RTCRayHit query{};
    query.ray.org_x = data.origin.x;
    query.ray.org_y = data.origin.y;
    query.ray.org_z = data.origin.z;
    query.ray.tnear = data.tMin;
    query.ray.dir_x = data.direction.x;
    query.ray.dir_y = data.direction.y;
    query.ray.dir_z = data.direction.z;
    query.ray.tfar = data.tMax;
    query.ray.mask = ~0u;
    query.ray.id = id;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
}

}  // namespace raylab

#endif
