// A software traversal's closest hit so far, and the test of one triangle.
#ifndef RAYLAB_CANDIDATE_GLSL
#define RAYLAB_CANDIDATE_GLSL

#include "trace/common.glsl"
#include "trace/quadric.glsl"
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

// kOpacity... of the microtriangle that the barycentrics lie in. Row i of four, from the first vertex towards the second,
// has 7 - 2i of them, which alternate between upright and turned.
uint opacityAt(uint opacity, vec2 barycentrics) {
    vec2 scaled = min(max(barycentrics, 0.0) * 4.0, 3.9999);
    vec2 corner = floor(scaled);
    vec2 inCell = scaled - corner;
    // Small whole numbers from the bits of a float: lavapipe converts one lane after the other.
    uvec2 cell = floatBitsToUint(corner + 8388608.0) & 3u;
    uint turned = inCell.x + inCell.y > 1.0 ? 1u : 0u;
    uint index = cell.x * (8u - cell.x) + min(2u * cell.y + turned, 6u - 2u * cell.x);
    return (opacity >> (2u * index)) & 3u;
}

void countPrimitive(bool tested, bool isHit) {
    if (kCount == 0u) return;
    counted.primitivesTested += uint(tested);
    counted.primitivesHit += uint(isHit);
}

// Ids order hits at equal distance, so that the answer does not depend on the tree. `w0` to `w3`: the triangle's words.
void considerTriangle(Ray ray, TriangleRay triangleRay, uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3, uint owner, bool isTriangle,
                      inout Candidate hit) {
    TriangleWords words = TriangleWords(uintBitsToFloat(w0.xyz), uintBitsToFloat(w1.xyz), uintBitsToFloat(w2.xyz),
                                        uintBitsToFloat(w3.xyz));
    float t;
    vec2 uv;
    bool accepted = intersectTriangle(triangleRay, words, ray.tMin, hit.t, t, uv) && isTriangle;
    uint instance = w0.w & kInstanceMask;
    if (needs(kNeedInstancing)) instance = owner != kInheritInstance ? owner : instance;
    accepted = accepted && (t < hit.t || idsBefore(instance, w1.w, hit.instance, hit.primitive));
    if (needs(kNeedAlpha)) {
        uint opacity = opacityAt(w2.w, uv);
        accepted = accepted && opacity != kOpacityTransparent;
        hit.untested = accepted && opacity == kOpacityUnknown;
    }
    countPrimitive(isTriangle, accepted);
    hit.t = accepted ? t : hit.t;
    hit.barycentrics = accepted ? uv : hit.barycentrics;
    hit.instance = accepted ? instance : hit.instance;
    hit.primitive = accepted ? w1.w : hit.primitive;
}

// The same for the quadric that a slot's words name; `origin` and `direction` in the space of the tree. Its alpha is tested
// at once: behind a hole in its near side lies its far side.
void considerQuadric(Ray ray, TriangleRay local, uvec4 w0, uvec4 w1, uvec4 w2, uint owner, inout Candidate hit) {
    uint instance = w0.w & kInstanceMask;
    if (needs(kNeedInstancing)) instance = owner != kInheritInstance ? owner : instance;
    float tMin = ray.tMin;
    for (int side = 0; side < 2; ++side) {
        float t;
        vec2 uv;
        bool accepted = intersectQuadric(local.origin, local.direction, w0.x, tMin, hit.t, t, uv);
        accepted = accepted && (t < hit.t || idsBefore(instance, w1.w, hit.instance, hit.primitive));
        countPrimitive(side == 0, accepted);
        if (!accepted) return;
        if (!needs(kNeedAlpha) || w2.w == kAllOpaque || acceptsCandidate(instance, w1.w, uv, ray.key)) {
            hit = Candidate(t, uv, instance, w1.w, false);
            return;
        }
        tMin = t;
    }
}

void testTriangle(Ray ray, TriangleRay triangleRay, uint slot, uint owner, inout Candidate hit) {
    int at = int(slot * kWordsTraceTriangle);
    uvec4 w0 = texelFetch(traceTriangleWords, at);
    uvec4 w1 = texelFetch(traceTriangleWords, at + 1);
    uvec4 w2 = texelFetch(traceTriangleWords, at + 2);
    uvec4 w3 = uvec4(0u);
    if (kWordsTraceTriangle > 3u) w3 = texelFetch(traceTriangleWords, at + 3);
    bool isQuadric = needs(kNeedQuadrics) && (w0.w & kSlotIsQuadric) != 0u;
    considerTriangle(ray, triangleRay, w0, w1, w2, w3, owner, !isQuadric, hit);
    if (needs(kNeedQuadrics) && isQuadric) considerQuadric(ray, triangleRay, w0, w1, w2, owner, hit);
}

bool acceptsUntested(Candidate hit, uint key) {
    return acceptsCandidate(hit.instance, hit.primitive, hit.barycentrics, key);
}

#endif
