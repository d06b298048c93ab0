// What every traversal shares: the ray, the hit, and the one place where a candidate hit may be refused.
// A backend defines traceClosest(Ray, out Hit) and traceOccluded(Ray); integrators see nothing else.
#ifndef RAYLAB_TRACE_COMMON_GLSL
#define RAYLAB_TRACE_COMMON_GLSL

#include "lib/random.glsl"
#include "lib/scene_buffers.glsl"
#include "lib/texture.glsl"

struct Ray {
    vec3 origin;
    float tMin;
    vec3 direction;  // any length; t counts in it
    float tMax;
    uint key;  // decides blended alpha, the same way for every backend
};

struct Hit {
    float t;
    vec2 barycentrics;  // weights of the second and third vertex; of a quadric: its texture coordinates
    uint instance;
    uint primitive;  // index within the instance's mesh
};

const float kInfinity = 3.0e38;

uint tracedRays = 0u;  // by this invocation

RayCounts counted = RayCounts(0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u);  // where the kernel counts

vec2 triangleUv(uvec4 indices, vec2 barycentrics) {
    vec2 uv0 = uintBitsToFloat(texelFetch(vertexWords, int(indices.x * kWordsVertex + 1u)).xy);
    vec2 uv1 = uintBitsToFloat(texelFetch(vertexWords, int(indices.y * kWordsVertex + 1u)).xy);
    vec2 uv2 = uintBitsToFloat(texelFetch(vertexWords, int(indices.z * kWordsVertex + 1u)).xy);
    return uv0 + barycentrics.x * (uv1 - uv0) + barycentrics.y * (uv2 - uv0);
}

// Alpha test of a candidate. Masked: against the cutoff. Blended: stochastic, opaque with probability alpha.
bool acceptsCandidate(uint instance, uint primitive, vec2 barycentrics, uint key) {
    InstanceData data = loadInstanceHeader(instance);
    MaterialData material = loadMaterial(data.material);
    float alpha = material.alpha;
    if (needs(kNeedTextures) && material.baseColorTexture != kNoTextureIndex) {
        vec2 uv = barycentrics;
        if (!needs(kNeedQuadrics) || (data.flags & kInstanceQuadric) == 0u)
            uv = triangleUv(texelFetch(triangleWords, int(data.firstPrimitive + primitive)), barycentrics);
        alpha *= sampleTextureSharp(material.baseColorTexture, uv).a;
    }
    float cutoff = material.alphaCutoff == kAlphaBlend
                       ? unitFloat(hashCombine(hashCombine(key, instance), primitive))
                       : material.alphaCutoff;
    return material.alphaCutoff == kAlphaBlend ? cutoff < alpha : alpha >= cutoff;
}

#endif
