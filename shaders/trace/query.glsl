// Traversal by the driver, asked from within the kernel (VK_KHR_ray_query).
#ifndef RAYLAB_TRACE_QUERY_GLSL
#define RAYLAB_TRACE_QUERY_GLSL

#include "trace/hardware.glsl"

// A candidate's triangle is a hit where the alpha test passes.
void considerQueriedTriangle(rayQueryEXT query, Ray ray) {
    SlotIds ids = loadSlot(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false),
                           rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
    vec2 barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, false);
    if (acceptsTriangle(ids, barycentrics, ray.key)) rayQueryConfirmIntersectionEXT(query);
}

// The ray has entered a quadric's box. `nearest` and `nearestUv`: of the quadrics that it hit.
void considerQueriedQuadric(rayQueryEXT query, Ray ray, inout float nearest, inout vec2 nearestUv) {
    SlotIds ids = loadSlot(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false),
                           rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
    vec3 origin = rayQueryGetIntersectionObjectRayOriginEXT(query, false);
    vec3 direction = rayQueryGetIntersectionObjectRayDirectionEXT(query, false);
    float tMax = nearest;
    if (rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT)
        tMax = min(tMax, rayQueryGetIntersectionTEXT(query, true));
    float tMin = ray.tMin;
    for (int side = 0; side < 2; ++side) {
        float t;
        vec2 uv;
        if (!intersectQuadric(origin, direction, ids.quadric, tMin, tMax, t, uv)) return;
        if (acceptsQuadric(ids, uv, ray.key)) {
            nearest = t;
            nearestUv = uv;
            rayQueryGenerateIntersectionEXT(query, t);
            return;
        }
        tMin = t;
    }
}

bool findHit(Ray ray, bool anyHit, out Hit hit) {
    ++tracedRays;
    uint flags = anyHit ? gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsNoneEXT;
    if (!needs(kNeedAlpha)) flags |= gl_RayFlagsOpaqueEXT;
    rayQueryEXT query;
    rayQueryInitializeEXT(query, topLevel, flags, 0xffu, ray.origin, ray.tMin, ray.direction, ray.tMax);
    float nearestQuadric = ray.tMax;
    vec2 quadricTextureUv = vec2(0.0);
    while (rayQueryProceedEXT(query)) {
        if (kCount != 0u) ++counted.primitivesTested;
        bool isQuadric =
            rayQueryGetIntersectionTypeEXT(query, false) == gl_RayQueryCandidateIntersectionAABBEXT;
        if (needs(kNeedAlpha) && !isQuadric) considerQueriedTriangle(query, ray);
        if (needs(kNeedQuadrics) && isQuadric) considerQueriedQuadric(query, ray, nearestQuadric, quadricTextureUv);
    }
    uint kind = rayQueryGetIntersectionTypeEXT(query, true);
    if (kind == gl_RayQueryCommittedIntersectionNoneEXT) return false;
    if (anyHit) return true;
    bool isQuadric = needs(kNeedQuadrics) && kind == gl_RayQueryCommittedIntersectionGeneratedEXT;
    SlotIds ids = loadSlot(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true),
                           rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    hit.t = isQuadric ? nearestQuadric : rayQueryGetIntersectionTEXT(query, true);
    hit.barycentrics = isQuadric ? quadricTextureUv : rayQueryGetIntersectionBarycentricsEXT(query, true);
    hit.instance = ids.instance;
    hit.primitive = ids.primitive;
    return true;
}

bool traceClosest(Ray ray, out Hit hit) { return findHit(ray, false, hit); }

bool traceOccluded(Ray ray) {
    Hit hit;
    return findHit(ray, true, hit);
}

#endif
