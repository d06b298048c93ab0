// Every triangle of every instance, no BVH: the "before" of each before-and-after, and an independent judge of the trees.
#ifndef RAYLAB_TRACE_BRUTE_GLSL
#define RAYLAB_TRACE_BRUTE_GLSL

#include "trace/common.glsl"
#include "trace/triangle.glsl"

bool testAll(Ray ray, bool anyHit, out Hit hit) {
    hit = Hit(ray.tMax, vec2(0.0), kInheritInstance, 0u);
    ++tracedRays;
    for (uint i = 0u; i < frame.traceInstanceCount; ++i) {
        int at = int(i * kWordsTraceInstance);
        vec4 row0 = uintBitsToFloat(texelFetch(traceInstanceWords, at));
        vec4 row1 = uintBitsToFloat(texelFetch(traceInstanceWords, at + 1));
        vec4 row2 = uintBitsToFloat(texelFetch(traceInstanceWords, at + 2));
        uint owner = texelFetch(traceInstanceWords, at + 4).w;
        uvec4 range = texelFetch(traceInstanceWords, at + 5);
        vec4 o = vec4(ray.origin, 1.0);
        vec3 origin = vec3(dot(row0, o), dot(row1, o), dot(row2, o));
        vec3 direction = vec3(dot(row0.xyz, ray.direction), dot(row1.xyz, ray.direction), dot(row2.xyz, ray.direction));
        ShearedRay sheared = shearRay(origin, direction);
        for (uint slot = range.x; slot < range.x + range.y; ++slot) {
            int word = int(slot * kWordsTraceTriangle);
            uvec4 p0 = texelFetch(traceTriangleWords, word);
            uvec4 p1 = texelFetch(traceTriangleWords, word + 1);
            uvec4 p2 = texelFetch(traceTriangleWords, word + 2);
            float t;
            vec2 uv;
            bool candidate = intersectTriangle(sheared, uintBitsToFloat(p0.xyz), uintBitsToFloat(p1.xyz),
                                               uintBitsToFloat(p2.xyz), ray.tMin, hit.t, t, uv);
            uint instance = owner != kInheritInstance ? owner : p0.w;
            candidate = candidate && comesFirst(t, instance, p1.w, hit);
            if (needs(kNeedAlpha) && candidate && p2.w != 0u) candidate = acceptsCandidate(instance, p1.w, uv, ray.key);
            if (candidate) hit = Hit(t, uv, instance, p1.w);
        }
        if (anyHit && hit.instance != kInheritInstance) return true;
    }
    return hit.instance != kInheritInstance;
}

bool traceClosest(Ray ray, out Hit hit) { return testAll(ray, false, hit); }

bool traceOccluded(Ray ray) {
    Hit hit;
    return testAll(ray, true, hit);
}

#endif
