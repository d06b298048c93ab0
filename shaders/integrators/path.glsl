// Path tracing in one kernel: around the two trace calls. A path of maxDepth scattering events at most.
#ifndef RAYLAB_INTEGRATOR_PATH_GLSL
#define RAYLAB_INTEGRATOR_PATH_GLSL

#include "integrators/path_bounce.glsl"

// From a ray to the next one and its shadow ray. False where the path ends.
bool followRay(inout PathState path, inout Ray ray, Sampler random) {
    ray.key = pathTraceKey(random, path.bounce);
    Hit hit;
    bool isHit = traceClosest(ray, hit);
    ShadowRay shadow;
    bool lives = shadePath(path, ray, hit, isHit, random, shadow);
    if (needs(kNeedLights) && shadow.isAsked && !traceOccluded(shadow.ray)) path.radiance += shadow.light;
    return lives;
}

// The radiance of a path that is under way.
vec3 followPath(PathState path, Ray ray, Sampler random) {
    while (followRay(path, ray, random)) continue;
    return path.radiance;
}

#endif
