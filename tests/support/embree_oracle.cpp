#include "tests/support/embree_oracle.h"

#if RAYLAB_EMBREE
#include <embree3/rtcore.h>

#include <algorithm>
#include <memory>
#endif

namespace raylab::support {

#if RAYLAB_EMBREE

namespace {

using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, decltype(&rtcReleaseDevice)>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, decltype(&rtcReleaseScene)>;

template <class T>
void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& values) {
    void* memory = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
    std::copy(values.begin(), values.end(), static_cast<T*>(memory));
}

SceneHandle makeRobustScene(RTCDevice device, const accel_test::TestMesh& mesh) {
    SceneHandle scene(rtcNewScene(device), &rtcReleaseScene);
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.positions);
    fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
}

shared::HitData closest(RTCScene scene, const shared::RayData& ray, const Flattened& flat) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray.org_x = ray.origin.x;
    query.ray.org_y = ray.origin.y;
    query.ray.org_z = ray.origin.z;
    query.ray.tnear = ray.tMin;
    query.ray.dir_x = ray.direction.x;
    query.ray.dir_y = ray.direction.y;
    query.ray.dir_z = ray.direction.z;
    query.ray.tfar = ray.tMax;
    query.ray.mask = ~0u;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &query);
    shared::HitData hit{};
    hit.t = -1.0f;
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
    const glm::uvec2 id = flat.ids[query.hit.primID];
    hit.t = query.ray.tfar;
    hit.u = query.hit.u;
    hit.v = query.hit.v;
    hit.instance = id.x;
    hit.primitive = id.y;
    return hit;
}

}  // namespace

std::optional<std::vector<shared::HitData>> embreeHits(const Flattened& flat, std::span<const shared::RayData> rays) {
    const DeviceHandle device(rtcNewDevice(nullptr), &rtcReleaseDevice);
    const SceneHandle scene = makeRobustScene(device.get(), flat.mesh);
    std::vector<shared::HitData> hits;
    for (const shared::RayData& ray : rays) hits.push_back(closest(scene.get(), ray, flat));
    return hits;
}

#else

std::optional<std::vector<shared::HitData>> embreeHits(const Flattened&, std::span<const shared::RayData>) {
    return std::nullopt;
}

#endif

}  // namespace raylab::support
