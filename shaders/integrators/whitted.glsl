// Whitted's ray tracer (CACM 23(6), 1980): the light of all punctual lights, and both the mirrored and the refracted ray of
// each hit, depth first by a stack. Nothing is random but the place within the pixel and blended alpha.
#ifndef RAYLAB_INTEGRATOR_WHITTED_GLSL
#define RAYLAB_INTEGRATOR_WHITTED_GLSL

#include "lib/lights.glsl"
#include "lib/sampler.glsl"
#include "materials/phong.glsl"

// A ray that is still to be followed, and what its light counts.
struct Branch {
    vec3 origin;
    float width;  // of its cone
    vec3 direction;
    uint depth;  // mirrored and refracted so many times
    vec3 weight;
};

// Of two branches the weaker is followed first and the other waits: the two weights add up to the one before at most, so
// with each branch that waits the weight halves, and after so many nothing is left that the film could hold.
const uint kWaitingBranches = 24u;
const float kSmallestWeight = 5.9604644775390625e-8;  // 2^-24

const uint kMostPanes = 32u;  // that a shadow ray passes through

bool isWorthwhile(vec3 weight) { return dot(weight, vec3(1.0 / 3.0)) >= max(frame.threshold, kSmallestWeight); }

// Light that the surfaces along the ray let through, on a straight line. What is mirrored away counts as on entering, on
// both faces of a solid: light that came in gets out on such a line.
vec3 lightThroughGlass(Ray ray) {
    vec3 passed = vec3(1.0);
    for (uint i = 0u; i <= kMostPanes; ++i) {
        Hit hit;
        if (!traceClosest(ray, hit)) return passed;
        Surface s = surfaceAt(ray, hit, RayCone(0.0, 0.0), 0.5);
        PhongData p = phongAt(s);
        passed *= sharesOf(p, s.thin, -dot(ray.direction, s.normal), p.ior).refracted;
        if (!isWorthwhile(passed)) return vec3(0.0);
        ray.origin = offsetOrigin(s, ray.direction);
        ray.tMax -= hit.t;
    }
    return vec3(0.0);
}

vec3 lightThatArrives(Ray ray) {
    if (kShadows == kShadowsNone) return vec3(1.0);
    if (kShadows == kShadowsGlass && needs(kNeedTransmission)) return lightThroughGlass(ray);
    return traceOccluded(ray) ? vec3(0.0) : vec3(1.0);
}

// From the inverse square to the attenuation chosen, which all are 1 at distance 1.
float attenuationChange(float distance) {
    if (kAttenuation == kAttenuationQuadratic || distance >= kInfinity) return 1.0;
    return kAttenuation == kAttenuationLinear ? distance : distance * distance;
}

vec3 lightOfAll(PhongData p, Surface s, vec3 wo, uint key) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < frame.punctualCount; ++i) {
        LightSample light = punctualLight(s.position, i);
        vec3 lit = light.radiance * attenuationChange(light.distance) * phongReflection(p, s, wo, light.direction);
        if (isBlack(lit)) continue;
        sum += lit * lightThatArrives(Ray(offsetOrigin(s, light.direction), 0.0, light.direction, light.distance, key));
    }
    return sum * kInvPi;
}

// Radiance that the surface itself sends back; the light of its branches is not in it.
vec3 localRadiance(PhongData p, Surface s, vec3 wo, uint key) {
    vec3 sum = frame.ambient * p.diffuse;
    if (needs(kNeedEmissive)) sum += s.emission;
    if (needs(kNeedPunctual)) sum += lightOfAll(p, s, wo, key);
    return sum;
}

bool clears(vec3 direction, vec3 normal) { return dot(direction, normal) > 0.0; }

// Where `branch` goes on: the branch of the mirror direction and of the refracted one, of weight 0 where there is none.
void split(PhongData p, Surface s, Branch branch, out Branch mirrored, out Branch refracted) {
    float cosO = -dot(branch.direction, s.normal);
    float eta = relativeIndex(p, s);
    Shares shares = sharesOf(p, s.thin, cosO, eta);
    vec3 wi = reflect(branch.direction, s.normal);
    vec3 weight = clears(wi, s.geometricNormal) ? branch.weight * shares.mirrored : vec3(0.0);
    mirrored = Branch(offsetOrigin(s, wi), branch.width, wi, branch.depth + 1u, weight);
    refracted = mirrored;
    refracted.weight = vec3(0.0);
    if (!needs(kNeedTransmission) || isBlack(shares.refracted)) return;
    wi = s.thin ? branch.direction : normalize(refract(branch.direction, s.normal, 1.0 / eta));
    weight = clears(wi, -s.geometricNormal) ? branch.weight * shares.refracted : vec3(0.0);
    refracted = Branch(offsetOrigin(s, wi), branch.width, wi, branch.depth + 1u, weight);
}

vec3 integrateWhitted(Ray ray, RayCone cone, Sampler random) {
    vec3 radiance = vec3(0.0);
    Branch waiting[kWaitingBranches];
    uint waitingCount = 0u;
    Branch branch = Branch(ray.origin, 0.0, ray.direction, 0u, vec3(1.0));
    for (uint rays = 0u;; ++rays) {
        ray = Ray(branch.origin, 0.0, branch.direction, kInfinity, traceKey(random, rays));
        bool goesOn = false;
        Hit hit;
        if (!traceClosest(ray, hit)) {
            if (needs(kNeedEnvironment)) radiance += branch.weight * environmentRadiance(ray.direction);
        } else {
            branch.width += cone.spread * hit.t;
            Surface s = surfaceAt(ray, hit, RayCone(branch.width, cone.spread), 0.5);
            PhongData p = phongAt(s);
            radiance += branch.weight * localRadiance(p, s, -ray.direction, ray.key);
            if (needs(kNeedSpecular | kNeedTransmission)) {
                Branch mirrored, refracted;
                split(p, s, branch, mirrored, refracted);
                bool isDeepest = branch.depth >= frame.maxDepth;
                if (kBeyond == kBeyondAverage && isDeepest) radiance += frame.ambient * (mirrored.weight + refracted.weight);
                bool mirrors = !isDeepest && isWorthwhile(mirrored.weight);
                bool refracts = needs(kNeedTransmission) && !isDeepest && isWorthwhile(refracted.weight);
                bool isMirrorFirst = dot(mirrored.weight - refracted.weight, vec3(1.0)) < 0.0;
                if (mirrors && refracts) waiting[waitingCount++] = isMirrorFirst ? refracted : mirrored;
                goesOn = mirrors || refracts;
                branch = mirrors && (isMirrorFirst || !refracts) ? mirrored : refracted;
            }
        }
        if (goesOn) continue;
        if (waitingCount == 0u) break;
        branch = waiting[--waitingCount];
    }
    return radiance;
}

#endif
