// The dispatcher: radiance along a camera ray by the integrator that the kernel is specialised to.
#ifndef RAYLAB_INTEGRATE_GLSL
#define RAYLAB_INTEGRATE_GLSL

#include "lib/camera.glsl"
#include "integrators/ao.glsl"
#include "integrators/direct.glsl"
#include "integrators/path.glsl"
#include "integrators/views.glsl"
#include "integrators/whitted.glsl"

// A camera ray, and the random numbers of all that follows.
struct CameraSample {
    Ray ray;
    RayCone cone;
    Sampler random;
};

CameraSample startSample(uvec2 pixel, uint sampleIndex) {
    Sampler random = makeSampler(frame.seed, pixel, frame.width, sampleIndex);
    setRayTime(random);
    return CameraSample(cameraRay(pixel, random), RayCone(0.0, frame.pixelSpread), random);
}

// By all integrators but `path`, whose loop is over the bounces of all samples (film/render_main.glsl).
vec3 integrate(uvec2 pixel, uint sampleIndex) {
    CameraSample start = startSample(pixel, sampleIndex);
    Ray ray = start.ray;
    RayCone cone = start.cone;
    Sampler random = start.random;
    if (kIntegrator == kIntegratorDirect) return integrateDirect(ray, cone, random);
    if (kIntegrator == kIntegratorAo) return integrateAo(ray, cone, random);
    if (kIntegrator == kIntegratorWhitted) return integrateWhitted(ray, cone, random);
    return integrateView(ray, cone, random);
}

#endif
