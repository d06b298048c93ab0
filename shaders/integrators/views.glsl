// What the first hit knows, as colours.
#ifndef RAYLAB_INTEGRATOR_VIEWS_GLSL
#define RAYLAB_INTEGRATOR_VIEWS_GLSL

#include "lib/sampler.glsl"
#include "lib/surface.glsl"

vec3 colourOfId(uint id) {
    uint h = hashUint(id + 1u);
    return vec3(0.15) + 0.85 * vec3(h & 255u, (h >> 8) & 255u, (h >> 16) & 255u) / 255.0;
}

vec3 integrateView(Ray ray, RayCone cone, Sampler random) {
    Hit hit;
    ray.key = traceKey(random, 0u);
    if (!traceClosest(ray, hit)) return vec3(0.0);
    if (kIntegrator == kIntegratorDepth) return vec3(hit.t);
    if (kIntegrator == kIntegratorPrimitive) return colourOfId(hit.primitive);
    if (kIntegrator == kIntegratorInstance) return colourOfId(hit.instance);
    if (kIntegrator == kIntegratorBarycentrics)
        return vec3(1.0 - hit.barycentrics.x - hit.barycentrics.y, hit.barycentrics);
    cone.width += cone.spread * hit.t;
    Surface s = surfaceAt(ray, hit, cone, 0.5);
    if (kIntegrator == kIntegratorNormal) return 0.5 + 0.5 * s.normal;
    if (kIntegrator == kIntegratorUv) return vec3(fract(s.uv), 0.0);
    return s.baseColor;
}

#endif
