// The dispatcher: a surface's lobes behind two functions. A lobe that the scene does not need is not in the kernel.
#ifndef RAYLAB_MATERIALS_GLSL
#define RAYLAB_MATERIALS_GLSL

#include "lib/surface.glsl"

struct BsdfSample {
    vec3 direction;  // world, unit
    vec3 weight;     // f cos / pdf; zero: absorbed
    float pdf;       // over solid angle; 0 for a mirror direction
    bool transmitted;
};

const BsdfSample kAbsorbed = BsdfSample(vec3(0.0, 1.0, 0.0), vec3(0.0), 0.0, false);

#include "materials/base.glsl"
#include "materials/glass.glsl"
#include "materials/layers.glsl"

// How an opaque surface is drawn from: the base with sheen on it, and the clear coat.
struct Opaque {
    Base base;
    float coatShare;  // probability of the clear coat
};

Opaque opaqueOf(Surface s, vec3 wo) {
    float cosO = dot(wo, s.normal);
    Opaque o = Opaque(baseOf(s, cosO), 0.0);
    if (needs(kNeedSheen)) {
        float sheen = sheenReflected(s, cosO);
        float scattered = o.base.albedo * (1.0 - o.base.specularShare) + sheen;
        o.base.albedo += sheen;
        o.base.specularShare = o.base.specularShare > 0.0 && sheen > 0.0
                                   ? clamp(1.0 - scattered / o.base.albedo, 0.1, 0.9) : o.base.specularShare;
    }
    if (needs(kNeedClearcoat)) {
        float coat = clearcoatAlbedo(s, wo);
        float below = (1.0 - coat) * o.base.albedo;
        o.coatShare = coat > 0.0 ? clamp(coat / (coat + below), 0.1, below > 0.0 ? 0.9 : 1.0) : 0.0;
    }
    return o;
}

// What sheen and clear coat leave of the lobes of the base, between two directions.
float underSheen(Surface s, float cosO, float cosI) {
    return 1.0 - max(sheenReflected(s, cosO), sheenReflected(s, cosI));
}
float underClearcoat(Surface s, vec3 wo, vec3 wi) { return 1.0 - max(clearcoatAlbedo(s, wo), clearcoatAlbedo(s, wi)); }

// f of all opaque lobes that are no mirrors, and their density: both directions above the surface.
vec3 evalOpaque(Surface s, Opaque o, vec3 wo, vec3 wi, out float pdf) {
    float cosO = dot(wo, s.normal), cosI = dot(wi, s.normal);
    vec3 value = evalBase(s, o.base, wo, wi, pdf);
    if (needs(kNeedSheen) && !isBlack(s.lobes.sheenColor))
        value = value * underSheen(s, cosO, cosI) + evalSheen(s, wo, wi);
    if (needs(kNeedClearcoat) && s.lobes.clearcoat > 0.0) {
        float coatPdf;
        float coat = evalClearcoat(s, wo, wi, coatPdf);
        value = value * underClearcoat(s, wo, wi) + vec3(coat);
        pdf = mix(pdf, coatPdf, o.coatShare);
    }
    return value;
}

// f |cos| of the lobes that scatter around, and the density with which sampleBsdf chooses wi. Both directions world, unit; `o` of
// this surface and wo.
vec3 evalBsdf(Surface s, Opaque o, vec3 wo, vec3 wi, out float pdf) {
    pdf = 0.0;
    float cosO = dot(wo, s.normal), cosI = dot(wi, s.normal);
    if (cosO <= 0.0 || cosI * dot(wi, s.geometricNormal) <= 0.0) return vec3(0.0);
    if (cosI < 0.0 && !needs(kNeedRoughTransmission)) return vec3(0.0);
    float opaque = opaqueShare(s);
    vec3 value = vec3(0.0);
    if (opaque > 0.0 && cosI > 0.0) {
        value = opaque * cosI * evalOpaque(s, o, wo, wi, pdf);
        pdf *= opaque;
    }
    if (needs(kNeedRoughTransmission) && opaque < 1.0 && isRoughGlass(s)) {
        float glassPdf;
        value += (1.0 - opaque) * evalRoughGlass(s, wo, wi, glassPdf);
        pdf += (1.0 - opaque) * glassPdf;
    }
    return value;
}

BsdfSample mirrored(Surface s, vec3 n, vec3 wo, vec3 weight) {
    vec3 wi = reflect(-wo, n);
    return dot(wi, s.geometricNormal) > 0.0 ? BsdfSample(wi, weight, 0.0, false) : kAbsorbed;
}

// A direction whose weight and density are those of all lobes that scatter around.
struct Drawn {
    BsdfSample mirror;  // used where nothing scatters
    vec3 direction;
    bool scatters;
};

Drawn drawnMirror(BsdfSample mirror) { return Drawn(mirror, vec3(0.0), false); }
Drawn drawnAround(vec3 direction) { return Drawn(kAbsorbed, direction, true); }

Drawn drawBase(Surface s, Opaque o, mat3 world, vec3 wo, float lobe, vec2 u) {
    float cosO = dot(wo, s.normal);
    if (needs(kNeedSpecular) && lobe < o.base.specularShare) {
        if (!isSmooth(s)) {
            vec3 h = sampleFacet(s, world, wo, u);
            return drawnAround(2.0 * dot(wo, h) * h - wo);
        }
        vec3 weight = fresnelSchlick(o.base.f0, o.base.f90, cosO) / (o.base.specularShare * (1.0 - o.coatShare));
        if (needs(kNeedSheen)) weight *= underSheen(s, cosO, cosO);
        if (needs(kNeedClearcoat)) weight *= underClearcoat(s, wo, reflect(-wo, s.normal));
        return drawnMirror(mirrored(s, s.normal, wo, weight));
    }
    float pdf;
    return drawnAround(world * sampleCosineHemisphere(u, pdf));
}

Drawn drawLobe(Surface s, Opaque o, vec3 wo, float lobe, vec2 u) {
    if (needs(kNeedTransmission)) {
        float through = throughShare(s);
        if (lobe < through) {
            if (!isRoughGlass(s)) return drawnMirror(sampleTransmission(s, wo, lobe / through));
            vec3 wi = sampleRoughGlass(s, wo, lobe / through, u);
            return wi == vec3(0.0) ? drawnMirror(kAbsorbed) : drawnAround(wi);
        }
        lobe = (lobe - through) / (1.0 - through);
    }
    mat3 world = shadingFrame(s);
    if (needs(kNeedClearcoat) && o.coatShare > 0.0) {
        if (lobe < o.coatShare) {
            vec3 n = coatNormal(s);
            if (isCoatSmooth(s))
                return drawnMirror(mirrored(s, n, wo, vec3(s.lobes.clearcoat * clearcoatFresnel(dot(wo, n)) / o.coatShare)));
            mat3 coat = needs(kNeedCoatNormals) ? frameAround(n) : world;
            vec3 h = coat * sampleGgxNormal(wo * coat, vec2(s.lobes.clearcoatAlpha), u);
            return drawnAround(2.0 * dot(wo, h) * h - wo);
        }
        lobe = (lobe - o.coatShare) / (1.0 - o.coatShare);
    }
    return drawBase(s, o, world, wo, lobe, u);
}

// `lobe` chooses between the lobes, `u` within one. The lobes are evaluated in one place: where lanes take both sides of each
// branch, each place is paid for.
BsdfSample sampleBsdf(Surface s, Opaque o, vec3 wo, float lobe, vec2 u) {
    Drawn drawn = drawLobe(s, o, wo, lobe, u);
    if (!drawn.scatters) return drawn.mirror;
    float pdf;
    vec3 value = evalBsdf(s, o, wo, drawn.direction, pdf);
    return pdf > 0.0 ? BsdfSample(drawn.direction, value / pdf, pdf, dot(drawn.direction, s.normal) < 0.0) : kAbsorbed;
}

#endif
