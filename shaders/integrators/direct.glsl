// Light of all punctual lights without noise, and a chain of mirror images: at each hit one ray is followed at most, up to
// maxDepth. Nothing is random but the place within the pixel, the levels of textures and blended alpha.
#ifndef RAYLAB_INTEGRATOR_DIRECT_GLSL
#define RAYLAB_INTEGRATOR_DIRECT_GLSL

#include "lib/lights.glsl"
#include "lib/sampler.glsl"
#include "materials/cook_torrance.glsl"

const uint kPairDirectTexture = 2u;  // of the first hit; one pair a hit

vec3 punctualRadiance(Surface s, vec3 wo, uint key) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < frame.punctualCount; ++i) {
        LightSample light = punctualLight(s.position, i);
        if (isBlack(light.radiance)) continue;
        vec3 f = evalCookTorrance(s, wo, light.direction);
        if (isBlack(f)) continue;
        Ray shadow = Ray(offsetOrigin(s, light.direction), 0.0, light.direction, light.distance, key);
        if (kShadows != kShadowsNone && traceOccluded(shadow)) continue;
        sum += f * light.radiance;
    }
    return sum;
}

// The mirror image. Glass hands all of its light to the likelier of reflection and refraction, so that one ray suffices.
BsdfSample followedRay(Surface s, vec3 wo) {
    if (needs(kNeedTransmission) && opaqueShare(s) < 1.0) {
        BsdfSample through = sampleTransmission(s, wo, 0.5);
        through.weight *= 1.0 - opaqueShare(s);
        return through;
    }
    if (!needs(kNeedSpecular) || !isMirror(s)) return kAbsorbed;
    float cosO = dot(wo, s.normal);
    vec3 wi = 2.0 * cosO * s.normal - wo;
    if (dot(wi, s.geometricNormal) <= 0.0) return kAbsorbed;
    return BsdfSample(wi, reflectanceAt(s, cosO), 0.0, false);
}

vec3 integrateDirect(Ray ray, RayCone cone, Sampler random) {
    vec3 radiance = vec3(0.0);
    vec3 throughput = vec3(1.0);
    for (uint bounce = 0u;; ++bounce) {
        ray.key = traceKey(random, bounce);
        Hit hit;
        if (!traceClosest(ray, hit)) {
            if (needs(kNeedEnvironment)) radiance += throughput * environmentRadiance(ray.direction);
            break;
        }
        vec3 wo = -ray.direction;
        cone.width += cone.spread * hit.t;
        float level = needs(kNeedTextures) ? sample2D(random, kPairDirectTexture + bounce).x : 0.0;
        Surface s = surfaceAt(ray, hit, cone, level);
        if (needs(kNeedEmissive)) radiance += throughput * s.emission;
        radiance += throughput * frame.ambient * opaqueShare(s) * diffuseAlbedo(s);
        if (needs(kNeedPunctual)) radiance += throughput * punctualRadiance(s, wo, ray.key);
        if (bounce >= frame.maxDepth || !needs(kNeedSpecular | kNeedTransmission)) break;
        BsdfSample next = followedRay(s, wo);
        if (isBlack(next.weight)) break;
        throughput *= next.weight;
        if (dot(throughput, vec3(1.0 / 3.0)) < frame.threshold) break;
        ray = Ray(offsetOrigin(s, next.direction), 0.0, next.direction, kInfinity, 0u);
    }
    return radiance;
}

#endif
