// The dispatcher: radiance along a camera ray by the integrator that the kernel is specialised to.
#ifndef RAYLAB_INTEGRATE_GLSL
#define RAYLAB_INTEGRATE_GLSL

#include "integrators/path.glsl"
#include "integrators/views.glsl"
#include "lib/camera.glsl"

vec3 integrate(uvec2 pixel, uint sampleIndex) {
    Sampler random = makeSampler(frame.seed, pixel.y * frame.width + pixel.x, sampleIndex);
    vec3 direction = cameraDirection(pixel, sample2D(random, 0u));
    Ray ray = Ray(frame.cameraPosition, 0.0, direction, kInfinity, 0u);
    RayCone cone = RayCone(0.0, frame.pixelSpread);
    if (kIntegrator == kIntegratorPath) return integratePath(ray, cone, random);
    return integrateView(ray, cone, random);
}

#endif
