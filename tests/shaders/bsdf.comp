#version 460
#extension GL_GOOGLE_include_directive : require
// Draws from, and evaluates, the material of the first triangle of a scene, the floor, seen from above.
#include "lib/random.glsl"
#include "materials/materials.glsl"
#include "bsdf_push.h"

layout(local_size_x = kWorkgroupSize) in;
layout(push_constant) uniform PushBlock { BsdfPush push; };
layout(set = 0, binding = kBindHits, std430) writeonly buffer ResultBlock { vec4 result[]; };

// Two numbers of the invocation.
vec2 numbers(uint i, uint pair) {
    uint key = hashCombine(frame.seed, hashCombine(i, pair));
    return vec2(unitFloat(key), unitFloat(hashUint(key ^ 0x68bc21ebu)));
}

Surface seenFrom(vec3 wo) {
    return surfaceAt(Ray(wo, 0.0, -wo, kInfinity, 0u), Hit(1.0, vec2(0.3), 0u, 0u), RayCone(0.0, 0.0), 0.5);
}

BsdfSample drawFrom(Surface s, uint i) {
    return sampleBsdf(s, opaqueOf(s, push.wo), push.wo, numbers(i, 0u).x, numbers(i, 1u));
}

vec3 evalFrom(vec3 wo, vec3 wi, out float pdf) {
    Surface s = seenFrom(wo);
    return evalBsdf(s, opaqueOf(s, wo), wo, wi, pdf);
}

vec4 sampled(uint i) {
    BsdfSample drawn = drawFrom(seenFrom(push.wo), i);
    return drawn.pdf > 0.0 ? vec4(drawn.direction, drawn.pdf) : vec4(0.0);
}

// Cells of a grid over azimuth and height; density last.
vec4 onGrid(uint i) {
    float phi = 2.0 * kPi * ((float(i % push.columns) + 0.5) / float(push.columns) - 0.5);
    float y = 2.0 * (float(i / push.columns) + 0.5) / float(push.count / push.columns) - 1.0;
    float r = sqrt(max(0.0, 1.0 - y * y)), pdf;
    vec3 f = evalFrom(push.wo, vec3(r * cos(phi), y, r * sin(phi)), pdf);
    return vec4(f, pdf);
}

// Above the horizon: seen from there a metal's normal bends with the view (lib/surface.glsl).
vec3 directionAbove(vec2 u) {
    float pdf;
    return normalize(sampleCosineHemisphere(u, pdf).xzy + vec3(0.0, 0.1, 0.0));
}

// f both ways between two directions above the surface.
vec4 bothWays(uint i) {
    float pdf;
    vec3 a = directionAbove(numbers(i, 0u)), b = directionAbove(numbers(i, 1u));
    return vec4(evalFrom(a, b, pdf).xy / b.y, evalFrom(b, a, pdf).xy / a.y);
}

// Light, not radiance: a boundary's scale by the square of the index is taken back.
vec4 left(uint i) {
    Surface s = seenFrom(push.wo);
    BsdfSample drawn = drawFrom(s, i);
    return vec4(drawn.weight * (drawn.transmitted && !s.thin ? s.eta * s.eta : 1.0), drawn.pdf);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    if (push.mode == kBsdfSample) result[i] = sampled(i);
    if (push.mode == kBsdfGrid) result[i] = onGrid(i);
    if (push.mode == kBsdfBothWays) result[i] = bothWays(i);
    if (push.mode == kBsdfAlbedo) result[i] = left(i);
}
