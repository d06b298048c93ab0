// Every triangle of every instance, no BVH: the "before" of each before-and-after, and an independent judge of the trees.
#ifndef RAYLAB_TRACE_BRUTE_GLSL
#define RAYLAB_TRACE_BRUTE_GLSL

#include "trace/two_level.glsl"

const float kBoxPadding = 4e-6;  // 33 units in the last place, as in trees
const bool kAsksBoxes = kTriangleTest == kTriangleWatertight && kSlab != kSlabPlain;

// Whether the ray meets the box of the triangle at `slot`, as a tree would ask before its test. Of a small triangle far beside the
// ray that it sees edge-on, all edge functions round to zero or one sign (products of size D^2 u against areas of D times its
// extent), and the watertight test would take it: one ray in a hundred, over 1.6 million triangles.
bool meetsTriangleBox(SlabRay ray, uint slot, float tMin, float tMax) {
    int at = int(slot * kWordsTraceTriangle);
    uvec4 first = texelFetch(traceTriangleWords, at);
    if (needs(kNeedQuadrics) && (first.w & kSlotIsQuadric) != 0u) return true;
    vec3 a = uintBitsToFloat(first.xyz);
    vec3 b = uintBitsToFloat(texelFetch(traceTriangleWords, at + 1).xyz);
    vec3 c = uintBitsToFloat(texelFetch(traceTriangleWords, at + 2).xyz);
    vec3 lo = min(min(a, b), c), hi = max(max(a, b), c);
    // Closed to rays that run in its faces, too: they have an interval of no length, or of the sign that rounding left.
    vec3 pad = kBoxPadding * max(max(abs(lo), abs(hi)), abs(ray.origin));
    vec3 low = (lo - pad - ray.origin) * ray.reciprocal;
    vec3 high = (hi + pad - ray.origin) * ray.reciprocal;
    vec3 enter = min(low, high), leave = max(low, high);
    float near = max(max(enter.x, enter.y), max(enter.z, tMin));
    float far = min(min(leave.x, leave.y), min(leave.z, tMax));
    return near <= far * (1.0 + kBoxPadding);
}

bool findHit(Ray ray, bool anyHit, out Candidate hit) {
    hit = noCandidate(ray.tMax);
    ++tracedRays;
    for (uint i = 0u; i < frame.traceInstanceCount; ++i) {
        uvec4 range = texelFetch(traceInstanceWords, int(i * kWordsTraceInstance) + 5);
        uint owner = texelFetch(traceInstanceWords, int(i * kWordsTraceInstance) + 4).w;
        vec3 origin, direction;
        countInstance();
        transformRay(ray, i, origin, direction);
        TriangleRay local = triangleRay(origin, direction);
        SlabRay slab = slabRay(origin, direction);
        for (uint slot = range.x; slot < range.x + range.y; ++slot) {
            Candidate found = hit;
            testTriangle(ray, local, slot, owner, found);
            if (needs(kNeedAlpha) && found.untested) {
                if (!acceptsUntested(found, ray.key)) continue;
                found.untested = false;
            }
            if (kAsksBoxes && !meetsTriangleBox(slab, slot, ray.tMin, found.t)) continue;
            hit = found;
        }
        if (anyHit && hit.instance != kInheritInstance) return true;
    }
    return hit.instance != kInheritInstance;
}

#include "trace/interface.glsl"

#endif
