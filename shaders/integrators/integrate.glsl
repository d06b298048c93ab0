// The dispatcher: radiance along a camera ray by the integrator that the kernel is specialised to.
#ifndef RAYLAB_INTEGRATE_GLSL
#define RAYLAB_INTEGRATE_GLSL

#include "lib/camera.glsl"
#include "integrators/ao.glsl"
#include "integrators/direct.glsl"
#include "integrators/path.glsl"
#include "integrators/views.glsl"
#include "integrators/whitted.glsl"

vec3 integrate(uvec2 pixel, uint sampleIndex) {
    Sampler random = makeSampler(frame.seed, pixel, frame.width, sampleIndex);
    setRayTime(random);
    Ray ray = cameraRay(pixel, random);
    RayCone cone = RayCone(0.0, frame.pixelSpread);
    if (kIntegrator == kIntegratorPath) return integratePath(ray, cone, random);
    if (kIntegrator == kIntegratorDirect) return integrateDirect(ray, cone, random);
    if (kIntegrator == kIntegratorAo) return integrateAo(ray, cone, random);
    if (kIntegrator == kIntegratorWhitted) return integrateWhitted(ray, cone, random);
    return integrateView(ray, cone, random);
}

#endif
