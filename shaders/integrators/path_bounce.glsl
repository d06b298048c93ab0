// One bounce of path tracing, from a hit to the next ray and to the shadow ray of a light sample: next event estimation and
// multiple importance sampling (Veach 1997), Russian roulette. It traces nothing, so that a loop around the two trace calls
// (path.glsl) and queues between kernels (wavefront/) run the same text.
#ifndef RAYLAB_INTEGRATOR_PATH_BOUNCE_GLSL
#define RAYLAB_INTEGRATOR_PATH_BOUNCE_GLSL

#include "lib/lights.glsl"
#include "lib/sampler.glsl"
#include "materials/media.glsl"

// Pairs of dimensions: 0 and 1 are the camera's (lib/camera.glsl); every bounce takes kPairsPerBounce from kPairFirstBounce on.
const uint kPairFirstBounce = 2u;
const uint kPairsPerBounce = 6u;
const uint kPairBsdf = 0u;
const uint kPairLobe = 1u;  // y: Russian roulette
const uint kPairLightKind = 2u;  // y: rounds texture levels
const uint kPairLightChoice = 3u;
const uint kPairLightPoint = 4u;
const uint kPairTraceKey = 5u;

// Rays after a rough bounce see textures through a wide cone: a lobe of GGX alpha a spans about a radians.
const float kDiffuseSpread = 0.3;

const uint kNeedLights = kNeedEmissive | kNeedPunctual | kNeedEnvironment;  // any: light is sampled

// What a path carries from one ray to the next.
struct PathState {
    vec3 throughput;
    vec3 radiance;
    float scatterPdf;   // of the ray's direction; 0: camera or mirror, which no light sample competes with
    float etaScale;     // what boundaries have divided radiance by
    Receiver receiver;  // that the last light sample was for
    RayCone cone;
    Media media;
    uint bounce;
};

// A light sample that waits for the answer to its shadow ray.
struct ShadowRay {
    Ray ray;
    vec3 light;  // what the path gains where nothing lies between
    bool isAsked;
};

const ShadowRay kNoShadowRay =
    ShadowRay(Ray(vec3(0.0), 0.0, vec3(0.0, 1.0, 0.0), 0.0, 0u), vec3(0.0), false);

PathState startPath(RayCone cone) {
    return PathState(vec3(1.0), vec3(0.0), 0.0, 1.0, Receiver(vec3(0.0), vec3(0.0)), cone, mediaInAir(), 0u);
}

uint firstPair(uint bounce) { return kPairFirstBounce + bounce * kPairsPerBounce; }

// Ray.key of the bounce's rays.
uint pathTraceKey(Sampler random, uint bounce) { return traceKey(random, firstPair(bounce) + kPairTraceKey); }

// Whom light reaches here. Where a surface lets light through, a light below it counts too.
Receiver receiverAt(Surface s) {
    bool isOpaque = !needs(kNeedTransmission) || s.transmission <= 0.0;
    return Receiver(s.position, isOpaque ? s.normal : vec3(0.0));
}

// Light that the ray comes upon before a surface, or where there is none, and what a medium leaves of the rest.
void gatherAlong(inout PathState path, Ray ray, float distance, bool isHit) {
    if (needs(kNeedShapes))
        path.radiance += path.throughput *
                         shapesAlong(ray, distance, path.media.absorption, path.receiver, path.scatterPdf);
    if (needs(kNeedAbsorption)) path.throughput *= transmittance(path.media.absorption, distance);
    if (needs(kNeedEnvironment) && !isHit) {
        float lightPdf;
        vec3 sky = environmentRadiance(ray.direction, lightPdf);
        float weight = path.scatterPdf > 0.0 ? misWeight(path.scatterPdf, lightPdf * frame.shareEnvironment) : 1.0;
        path.radiance += path.throughput * sky * weight;
    }
}

// Light that the surface sends along the ray that hit it.
void addEmission(inout PathState path, Surface s, Hit hit, vec3 wo) {
    if (isBlack(s.emission)) return;
    float distanceSquared = hit.t * hit.t, cosLight = abs(dot(s.geometricNormal, wo));
    float lightPdf = 0.0;
    if (kLightTree == 0u)
        lightPdf = pdfEmissive(s.emissionWeight, distanceSquared, cosLight);
    else if (path.scatterPdf > 0.0 && s.emissionWeight > 0.0)
        lightPdf = pdfEmissive(path.receiver, hit, distanceSquared, cosLight);
    path.radiance += path.throughput * s.emission * (path.scatterPdf > 0.0 ? misWeight(path.scatterPdf, lightPdf) : 1.0);
}

// One light and the way to it. `key`: of the ray that came here.
ShadowRay sampleDirect(PathState path, Surface s, Opaque o, vec3 wo, vec2 kind, vec2 choice, vec2 u, uint key) {
    LightSample light = sampleLight(path.receiver, kind.x, choice, u);
    if (isBlack(light.radiance)) return kNoShadowRay;
    float pdf;
    vec3 f = evalBsdf(s, o, wo, light.direction, pdf);
    if (isBlack(f)) return kNoShadowRay;
    vec3 origin = offsetOrigin(s, light.direction);
    // A sampled point is approached from outside: the last part in 1e4 of the way is not searched for occluders, which
    // is more than the rounding error of the distance and of the point.
    float tMax = light.distance < kInfinity ? light.distance * 0.9999 : kInfinity;
    if (needs(kNeedAbsorption)) {
        Media media = path.media;
        bool passes = needs(kNeedRoughTransmission) && dot(light.direction, s.normal) < 0.0;
        if (passes) media = across(media, s);
        f *= transmittance(media.absorption, light.distance);
    }
    vec3 gain = f * light.radiance * (light.pdf > 0.0 ? misWeight(light.pdf, pdf) : 1.0);
    return ShadowRay(Ray(origin, 0.0, light.direction, tMax, key), path.throughput * gain, true);
}

// From a surface to the next ray, by the material. False where the path ends.
bool scatterPath(inout PathState path, inout Ray ray, Surface s, Opaque o, vec3 wo, Sampler random) {
    uint pair = firstPair(path.bounce);
    vec2 lobe = sample2D(random, pair + kPairLobe);
    BsdfSample next = sampleBsdf(s, o, wo, lobe.x, sample2D(random, pair + kPairBsdf));
    bool lives = !isBlack(next.weight);
    path.throughput *= next.weight;
    if (needs(kNeedTransmission) && next.transmitted && !s.thin) {
        path.etaScale *= s.eta * s.eta;
        if (needs(kNeedAbsorption | kNeedNesting)) path.media = across(path.media, s);
    }
    // What is left, but for the scale of radiance inside a medium. From the first bounce on, paths of less than the threshold
    // survive in proportion to it; behind the roulette's depth all do.
    float left = maxComponent(path.throughput) * path.etaScale;
    float survival = path.bounce >= frame.rouletteDepth ? min(left, 0.95) : min(left * frame.inverseThroughputEnd, 1.0);
    lives = lives && !(lobe.y >= survival);
    path.throughput /= survival;
    path.scatterPdf = next.pdf;
    path.cone.spread += next.pdf > 0.0 ? kDiffuseSpread * min(s.metallic > 0.5 ? s.alpha : 1.0, 1.0) : 0.0;
    ray = Ray(offsetOrigin(s, next.direction), 0.0, next.direction, kInfinity, 0u);
    ++path.bounce;
    return lives;
}

// From what the ray hit, or did not, to the next ray. False where the path ends. `shadow` is still to be traced, whether
// the path lives or not; its light is the path's where nothing occludes it.
bool shadePath(inout PathState path, inout Ray ray, Hit hit, bool isHit, Sampler random, out ShadowRay shadow) {
    shadow = kNoShadowRay;
    gatherAlong(path, ray, isHit ? hit.t : kInfinity, isHit);
    bool lives = false;
    if (isHit) {
        uint pair = firstPair(path.bounce);
        vec3 wo = -ray.direction;
        path.cone.width += path.cone.spread * hit.t;
        vec2 lightKind = sample2D(random, pair + kPairLightKind);
        Surface s = surfaceAt(ray, hit, path.cone, lightKind.y);
        if (needs(kNeedNesting) && !isBoundary(path.media, s)) {
            path.media = across(path.media, s);
            path.scatterPdf = 0.0;  // no light sample sees through it
            ray = Ray(offsetOrigin(s, ray.direction), 0.0, ray.direction, kInfinity, 0u);
            lives = true;
        } else {
            if (needs(kNeedEmissive)) addEmission(path, s, hit, wo);
            if (path.bounce < frame.maxDepth) {
                Opaque o = opaqueOf(s, wo);
                if (needs(kNeedLights)) {
                    path.receiver = receiverAt(s);
                    shadow = sampleDirect(path, s, o, wo, lightKind, sample2D(random, pair + kPairLightChoice),
                                          sample2D(random, pair + kPairLightPoint), ray.key);
                }
                lives = scatterPath(path, ray, s, o, wo, random);
            }
        }
    }
    return lives;
}

#endif
