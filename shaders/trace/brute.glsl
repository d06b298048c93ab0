// Every triangle of every instance, no BVH: the "before" of each before-and-after, and an independent judge of the trees.
#ifndef RAYLAB_TRACE_BRUTE_GLSL
#define RAYLAB_TRACE_BRUTE_GLSL

#include "trace/two_level.glsl"

bool findHit(Ray ray, bool anyHit, out Candidate hit) {
    hit = noCandidate(ray.tMax);
    ++tracedRays;
    for (uint i = 0u; i < frame.traceInstanceCount; ++i) {
        uvec4 range = texelFetch(traceInstanceWords, int(i * kWordsTraceInstance) + 5);
        uint owner = texelFetch(traceInstanceWords, int(i * kWordsTraceInstance) + 4).w;
        vec3 origin, direction;
        transformRay(ray, i, origin, direction);
        TriangleRay local = triangleRay(origin, direction);
        for (uint slot = range.x; slot < range.x + range.y; ++slot) {
            Candidate found = hit;
            testTriangle(ray, local, slot, owner, found);
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
