#version 460
#extension GL_GOOGLE_include_directive : require
// Draws samples by one routine of lib/ or materials/, the sampler's numbers going in. tests/statistical/chi_squared_test.cpp
// counts where they fall.
#include "lib/environment.glsl"
#include "lib/filter.glsl"
#include "lib/light_shapes.glsl"
#include "lib/sampler.glsl"
#include "materials/ggx.glsl"
#include "routines.h"

layout(local_size_x = kWorkgroupSize) in;
layout(constant_id = kSpecRoutine) const uint kRoutine = kRoutinePair;
layout(push_constant) uniform PushBlock { SamplesPush push; };
layout(set = 0, binding = kBindHits, std430) writeonly buffer ResultBlock { vec4 result[]; };

// Of a rectangle 1 wide along x and `alpha` high along y, from the origin on, that shines along z; seen from `wo`.
vec4 drawRectangle(vec2 u) {
    PunctualData light;
    light.kind = kPunctualRectangle;
    light.position = vec3(0.0);
    light.direction = vec3(1.0, 0.0, 0.0);
    light.shape = vec3(0.0, push.alpha, 0.0);
    ShapePoint at = sampleShape(light, push.wo, u);
    ShapePoint met = hitShape(light, Ray(push.wo, 0.0, at.direction, kInfinity, 0u));
    return vec4((push.wo + at.distance * at.direction).xy, at.pdf, met.pdf);
}

// Of a sphere of radius `alpha` around the origin, seen from `wo`.
vec4 drawSphere(vec2 u) {
    PunctualData light;
    light.kind = kPunctualSphere;
    light.position = vec3(0.0);
    light.shape = vec3(push.alpha, 0.0, 0.0);
    ShapePoint at = sampleShape(light, push.wo, u);
    return vec4(at.direction, at.pdf);
}

// Of a disc in the sky towards `wo`, of 1 - cosine `alpha`.
vec4 drawSunDisc(vec2 u) {
    PunctualData light;
    light.kind = kPunctualSunDisc;
    light.direction = -push.wo;
    light.shape = vec3(push.alpha, 0.0, 0.0);
    ShapePoint at = sampleShape(light, vec3(0.0), u);
    return vec4(at.direction, at.pdf);
}

vec4 draw(vec2 u, vec2 v) {
    float pdf = 0.0;
    if (kRoutine == kRoutineCosine) {
        vec3 direction = sampleCosineHemisphere(u, pdf);
        return vec4(direction, pdf);
    }
    if (kRoutine == kRoutineGgxNormal) return vec4(sampleGgxNormal(push.wo, vec2(push.alpha), u), 0.0);
    if (kRoutine == kRoutineTriangle) return vec4(sampleTriangle(u), 0.0, 0.0);
    if (kRoutine == kRoutineDisc) return vec4(sampleDisc(u), 0.0, 0.0);
    if (kRoutine == kRoutineFilter) return vec4(sampleFilter(u), 0.0, 0.0);
    if (kRoutine == kRoutineRectangle) return drawRectangle(u);
    if (kRoutine == kRoutineSphere) return drawSphere(u);
    if (kRoutine == kRoutineSunDisc) return drawSunDisc(u);
    if (kRoutine == kRoutineEnvironment) {
        vec3 direction = sampleEnvironment(u, v);
        environmentRadiance(direction, pdf);
        return vec4(direction, pdf);
    }
    return vec4(u, v);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    uint pixel = i / push.samplesPerPixel;
    Sampler random = makeSampler(frame.seed, uvec2(pixel % push.pixelsPerRow, pixel / push.pixelsPerRow), push.pixelsPerRow,
                                 push.firstSample + i % push.samplesPerPixel);
    result[i] = draw(sample2D(random, 3u), sample2D(random, 4u));
}
