// Traversal by the driver's ray tracing pipeline (VK_KHR_ray_tracing_pipeline), called from the ray generation shader alone:
// recursion depth 1. Two hit groups (triangles, quadrics) and two miss shaders.
#ifndef RAYLAB_TRACE_PIPELINE_GLSL
#define RAYLAB_TRACE_PIPELINE_GLSL

#include "trace/pipeline_payload.glsl"

layout(location = 0) rayPayloadEXT HitPayload payload;

const uint kHardwareFlags = (kNeeds & kNeedAlpha) != 0u ? gl_RayFlagsNoneEXT : gl_RayFlagsOpaqueEXT;

bool traceClosest(Ray ray, out Hit hit) {
    ++tracedRays;
    payload.key = ray.key;
    traceRayEXT(topLevel, kHardwareFlags, 0xffu, 0u, 0u, 0u, ray.origin, ray.tMin, ray.direction, ray.tMax, 0);
    hit = Hit(payload.t, payload.barycentrics, payload.instance, payload.primitive);
    return payload.t >= 0.0;
}

bool traceOccluded(Ray ray) {
    ++tracedRays;
    payload.key = ray.key;
    payload.instance = 0u;  // the closest-hit shader is skipped; the miss shader alone answers
    traceRayEXT(topLevel, kHardwareFlags | gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT, 0xffu,
                0u, 0u, 1u, ray.origin, ray.tMin, ray.direction, ray.tMax, 0);
    return payload.instance != kInheritInstance;
}

#endif
