// Ambient occlusion: the share of a hit's cosine-weighted hemisphere that is free up to a distance (Zhukov, Iones, Kronin,
// "An Ambient Light Illumination Model", 1998; Landis, SIGGRAPH 2002), unbiased, by any-hit rays.
#ifndef RAYLAB_INTEGRATOR_AO_GLSL
#define RAYLAB_INTEGRATOR_AO_GLSL

#include "lib/sampler.glsl"
#include "lib/surface.glsl"

const uint kPairAo = 2u;  // of the first ray; one pair a ray. The camera's pair decides alpha along its ray.

vec3 integrateAo(Ray ray, RayCone cone, Sampler random) {
    Hit hit;
    ray.key = traceKey(random, 0u);
    if (!traceClosest(ray, hit)) return vec3(1.0);
    cone.width += cone.spread * hit.t;
    Surface s = surfaceAt(ray, hit, cone, 0.5);
    mat3 world = frameAround(s.normal);
    float open = 0.0;
    for (uint i = 0u; i < frame.aoRays; ++i) {
        float pdf;
        vec3 direction = world * sampleCosineHemisphere(sample2D(random, kPairAo + i), pdf);
        // Below the surface that a bent normal belongs to, nothing is open.
        if (dot(direction, s.geometricNormal) <= 0.0) continue;
        Ray probe = Ray(offsetOrigin(s, direction), 0.0, direction, frame.aoDistance, traceKey(random, kPairAo + i));
        if (!traceOccluded(probe)) open += frame.aoShare;
    }
    return vec3(open);
}

#endif
