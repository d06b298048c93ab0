// Path tracing with next event estimation and multiple importance sampling (Veach 1997), Russian roulette. A path of
// maxDepth scattering events at most; one loop around the two trace calls.
#ifndef RAYLAB_INTEGRATOR_PATH_GLSL
#define RAYLAB_INTEGRATOR_PATH_GLSL

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

// Whom light reaches here. Where a surface lets light through, a light below it counts too.
Receiver receiverAt(Surface s) {
    bool isOpaque = !needs(kNeedTransmission) || s.transmission <= 0.0;
    return Receiver(s.position, isOpaque ? s.normal : vec3(0.0));
}

vec3 directLight(Surface s, Media media, Receiver receiver, vec3 wo, vec2 kind, vec2 choice, vec2 u, uint key) {
    LightSample light = sampleLight(receiver, kind.x, choice, u);
    if (isBlack(light.radiance)) return vec3(0.0);
    float pdf;
    vec3 f = evalBsdf(s, wo, light.direction, pdf);
    if (isBlack(f)) return vec3(0.0);
    vec3 origin = offsetOrigin(s, light.direction);
    // A sampled point is approached from outside: the last part in 1e4 of the way is not searched for occluders, which
    // is more than the rounding error of the distance and of the point.
    float tMax = light.distance < kInfinity ? light.distance * 0.9999 : kInfinity;
    if (traceOccluded(Ray(origin, 0.0, light.direction, tMax, key))) return vec3(0.0);
    if (needs(kNeedAbsorption)) {
        bool passes = needs(kNeedRoughTransmission) && dot(light.direction, s.normal) < 0.0;
        if (passes) media = across(media, s);
        f *= transmittance(media.absorption, light.distance);
    }
    return f * light.radiance * (light.pdf > 0.0 ? misWeight(light.pdf, pdf) : 1.0);
}

vec3 integratePath(Ray ray, RayCone cone, Sampler random) {
    vec3 radiance = vec3(0.0);
    vec3 throughput = vec3(1.0);
    float scatterPdf = 0.0;  // of the direction that led here; 0: camera or mirror, which no light sample competes with
    Receiver receiver = Receiver(vec3(0.0), vec3(0.0));  // that the last light sample was for
    float etaScale = 1.0;
    Media media = mediaInAir();
    for (uint bounce = 0u;;) {
        uint pair = kPairFirstBounce + bounce * kPairsPerBounce;
        ray.key = traceKey(random, pair + kPairTraceKey);
        Hit hit;
        bool isHit = traceClosest(ray, hit);
        if (needs(kNeedShapes))
            radiance += throughput * shapesAlong(ray, isHit ? hit.t : kInfinity, media.absorption, receiver, scatterPdf);
        if (needs(kNeedAbsorption)) throughput *= transmittance(media.absorption, isHit ? hit.t : kInfinity);
        if (!isHit) {
            if (needs(kNeedEnvironment)) {
                float lightPdf;
                vec3 sky = environmentRadiance(ray.direction, lightPdf);
                float weight = scatterPdf > 0.0 ? misWeight(scatterPdf, lightPdf * frame.shareEnvironment) : 1.0;
                radiance += throughput * sky * weight;
            }
            break;
        }
        vec3 wo = -ray.direction;
        cone.width += cone.spread * hit.t;
        vec2 lightKind = sample2D(random, pair + kPairLightKind);
        Surface s = surfaceAt(ray, hit, cone, lightKind.y);
        if (needs(kNeedNesting) && !isBoundary(media, s)) {
            media = across(media, s);
            scatterPdf = 0.0;  // no light sample sees through it
            ray = Ray(offsetOrigin(s, ray.direction), 0.0, ray.direction, kInfinity, 0u);
            continue;
        }
        if (needs(kNeedEmissive) && !isBlack(s.emission)) {
            float distanceSquared = hit.t * hit.t, cosLight = abs(dot(s.geometricNormal, wo));
            float lightPdf = 0.0;
            if (kLightTree == 0u)
                lightPdf = pdfEmissive(s.emissionWeight, distanceSquared, cosLight);
            else if (scatterPdf > 0.0 && s.emissionWeight > 0.0)
                lightPdf = pdfEmissive(receiver, hit, distanceSquared, cosLight);
            radiance += throughput * s.emission * (scatterPdf > 0.0 ? misWeight(scatterPdf, lightPdf) : 1.0);
        }
        if (bounce >= frame.maxDepth) break;
        if (needs(kNeedEmissive | kNeedPunctual | kNeedEnvironment)) {
            receiver = receiverAt(s);
            radiance += throughput * directLight(s, media, receiver, wo, lightKind, sample2D(random, pair + kPairLightChoice),
                                                 sample2D(random, pair + kPairLightPoint), ray.key);
        }
        vec2 lobe = sample2D(random, pair + kPairLobe);
        BsdfSample next = sampleBsdf(s, wo, lobe.x, sample2D(random, pair + kPairBsdf));
        if (isBlack(next.weight)) break;
        throughput *= next.weight;
        if (needs(kNeedTransmission) && next.transmitted && !s.thin) {
            etaScale *= s.eta * s.eta;
            if (needs(kNeedAbsorption | kNeedNesting)) media = across(media, s);
        }
        if (bounce >= frame.rouletteDepth) {
            float survival = min(maxComponent(throughput) * etaScale, 0.95);
            if (lobe.y >= survival) break;
            throughput /= survival;
        }
        scatterPdf = next.pdf;
        cone.spread += next.pdf > 0.0 ? kDiffuseSpread * min(s.metallic > 0.5 ? s.alpha : 1.0, 1.0) : 0.0;
        ray = Ray(offsetOrigin(s, next.direction), 0.0, next.direction, kInfinity, 0u);
        ++bounce;
    }
    return radiance;
}

#endif
