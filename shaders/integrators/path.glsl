// Path tracing in one kernel: one loop around the two trace calls. A path of maxDepth scattering events at most.
#ifndef RAYLAB_INTEGRATOR_PATH_GLSL
#define RAYLAB_INTEGRATOR_PATH_GLSL

#include "integrators/path_bounce.glsl"

// The radiance of a path that is under way.
vec3 followPath(PathState path, Ray ray, Sampler random) {
    bool lives = true;
    while (lives) {
        ray.key = pathTraceKey(random, path.bounce);
        Hit hit;
        bool isHit = traceClosest(ray, hit);
        ShadowRay shadow;
        lives = shadePath(path, ray, hit, isHit, random, shadow);
        if (needs(kNeedLights) && shadow.isAsked && !traceOccluded(shadow.ray)) path.radiance += shadow.light;
    }
    return path.radiance;
}

vec3 integratePath(Ray ray, RayCone cone, Sampler random) { return followPath(startPath(cone), ray, random); }

#endif
