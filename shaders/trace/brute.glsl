// Every triangle of every instance, no BVH: the "before" of each before-and-after, and an independent judge of the trees.
#ifndef RAYLAB_TRACE_BRUTE_GLSL
#define RAYLAB_TRACE_BRUTE_GLSL

#include "trace/candidate.glsl"

bool findHit(Ray ray, bool anyHit, out Candidate hit) {
    hit = noCandidate(ray.tMax);
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
            Candidate found = hit;
            testTriangle(ray, sheared, slot, owner, found);
            if (needs(kNeedAlpha) && found.untested) {
                if (!acceptsUntested(found, ray.key)) continue;
                found.untested = false;
            }
            hit = found;
        }
        if (anyHit && hit.instance != kInheritInstance) return true;
    }
    return hit.instance != kInheritInstance;
}

#include "trace/interface.glsl"

#endif
