// A software traversal's closest hit so far, and the test of one triangle.
#ifndef RAYLAB_CANDIDATE_GLSL
#define RAYLAB_CANDIDATE_GLSL

#include "trace/common.glsl"
#include "trace/triangle.glsl"

struct Candidate {
    float t;
    vec2 barycentrics;
    uint instance;  // kInheritInstance: none yet
    uint primitive;
    bool untested;  // acceptsCandidate() has still to be asked
};

Candidate noCandidate(float tMax) { return Candidate(tMax, vec2(0.0), kInheritInstance, 0u, false); }

bool idsBefore(uint instanceA, uint primitiveA, uint instanceB, uint primitiveB) {
    return instanceA < instanceB || (instanceA == instanceB && primitiveA < primitiveB);
}

// Ids order hits at equal distance, so that the answer does not depend on the tree.
void testTriangle(Ray ray, ShearedRay sheared, uint slot, uint owner, inout Candidate hit) {
    int at = int(slot * kWordsTraceTriangle);
    uvec4 p0 = texelFetch(traceTriangleWords, at);
    uvec4 p1 = texelFetch(traceTriangleWords, at + 1);
    uvec4 p2 = texelFetch(traceTriangleWords, at + 2);
    float t;
    vec2 uv;
    bool accepted = intersectTriangle(sheared, uintBitsToFloat(p0.xyz), uintBitsToFloat(p1.xyz),
                                      uintBitsToFloat(p2.xyz), ray.tMin, hit.t, t, uv);
    uint instance = needs(kNeedInstancing) && owner != kInheritInstance ? owner : p0.w;
    accepted = accepted && (t < hit.t || idsBefore(instance, p1.w, hit.instance, hit.primitive));
    hit.t = accepted ? t : hit.t;
    hit.barycentrics = accepted ? uv : hit.barycentrics;
    hit.instance = accepted ? instance : hit.instance;
    hit.primitive = accepted ? p1.w : hit.primitive;
    if (needs(kNeedAlpha)) hit.untested = accepted && p2.w != 0u;
}

bool acceptsUntested(Candidate hit, uint key) {
    return acceptsCandidate(hit.instance, hit.primitive, hit.barycentrics, key);
}

#endif
