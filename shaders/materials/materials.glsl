// The dispatcher: a surface's lobes behind three functions. A lobe that the scene does not need is not in the kernel.
#ifndef RAYLAB_MATERIALS_GLSL
#define RAYLAB_MATERIALS_GLSL

#include "lib/surface.glsl"
#include "materials/dielectric.glsl"
#include "materials/ggx.glsl"
#include "materials/lambert.glsl"

struct BsdfSample {
    vec3 direction;  // world, unit
    vec3 weight;     // f cos / pdf; zero: absorbed
    float pdf;       // over solid angle; 0 for a mirror direction
    bool transmitted;
};

const BsdfSample kAbsorbed = BsdfSample(vec3(0.0, 1.0, 0.0), vec3(0.0), 0.0, false);

struct Lobes {
    vec3 diffuse;  // albedo
    vec3 f0;
    float f90;
    float specularShare;  // probability of the GGX lobe
};

vec3 diffuseAlbedo(Surface s) { return s.baseColor * (1.0 - s.metallic); }

// Reflectance at normal and at grazing incidence.
vec3 reflectance0(Surface s) {
    float r0 = (s.ior - 1.0) / (s.ior + 1.0);
    return mix(vec3(s.specular * r0 * r0), s.baseColor, s.metallic);
}
float reflectance90(Surface s) { return mix(s.specular, 1.0, s.metallic); }

Lobes lobesOf(Surface s, float cosO) {
    vec3 diffuse = diffuseAlbedo(s);
    if (!needs(kNeedSpecular)) return Lobes(diffuse, vec3(0.0), 0.0, 0.0);
    vec3 f0 = reflectance0(s);
    float f90 = reflectance90(s);
    float reflected = maxComponent(fresnelSchlick(f0, f90, cosO));
    float scattered = maxComponent(diffuse) * (1.0 - reflected);
    float share = reflected > 0.0 ? reflected / (reflected + scattered) : 0.0;
    return Lobes(diffuse, f0, f90, share > 0.0 ? clamp(share, 0.1, scattered > 0.0 ? 0.9 : 1.0) : 0.0);
}

// What does not pass through the surface.
float opaqueShare(Surface s) { return needs(kNeedTransmission) ? 1.0 - s.transmission * (1.0 - s.metallic) : 1.0; }

// Whether the rough lobes alone matter here: a mirror direction can't be connected to a light.
bool isSmooth(Surface s) { return s.alpha < kSmallestAlpha; }

// f cos of the lobes that scatter around, and the density with which sampleBsdf chooses wi. Both directions world, unit.
vec3 evalBsdf(Surface s, vec3 wo, vec3 wi, out float pdf) {
    pdf = 0.0;
    float cosO = dot(wo, s.normal), cosI = dot(wi, s.normal);
    if (cosI <= 0.0 || cosO <= 0.0 || dot(wi, s.geometricNormal) <= 0.0) return vec3(0.0);
    float opaque = opaqueShare(s);
    if (opaque <= 0.0) return vec3(0.0);
    Lobes lobes = lobesOf(s, cosO);
    if (!needs(kNeedSpecular)) {
        pdf = opaque * pdfCosineHemisphere(cosI);
        return opaque * cosI * evalLambert(lobes.diffuse);
    }
    vec3 h = normalize(wo + wi);
    vec3 fresnel = fresnelSchlick(lobes.f0, lobes.f90, dot(wo, h));
    vec3 value = (1.0 - maxComponent(fresnel) * (1.0 - s.metallic)) * evalLambert(lobes.diffuse);
    pdf = (1.0 - lobes.specularShare) * pdfCosineHemisphere(cosI);
    if (!isSmooth(s)) {
        float cosH = dot(h, s.normal);
        value += fresnel * evalGgxReflection(cosO, cosI, cosH, s.alpha);
        pdf += lobes.specularShare * pdfGgxReflection(cosO, cosH, s.alpha);
    }
    pdf *= opaque;
    return opaque * cosI * value;
}

BsdfSample sampleTransmission(Surface s, vec3 wo, float u) {
    float cosO = dot(wo, s.normal);
    float eta = s.frontFace || s.thin ? s.ior : 1.0 / s.ior;
    float cosT;
    float reflectance = fresnelDielectric(cosO, eta, cosT);
    if (s.thin) reflectance = thinReflectance(reflectance);
    if (u < reflectance) {
        vec3 wi = 2.0 * cosO * s.normal - wo;
        return dot(wi, s.geometricNormal) > 0.0 ? BsdfSample(wi, vec3(1.0), 0.0, false) : kAbsorbed;
    }
    if (s.thin) return BsdfSample(-wo, s.baseColor, 0.0, true);
    vec3 wi = normalize(-wo / eta + (cosO / eta - cosT) * s.normal);
    // Radiance is scaled by the square of the relative index where it enters a denser medium (Veach, section 5.2).
    return dot(wi, s.geometricNormal) < 0.0 ? BsdfSample(wi, s.baseColor / (eta * eta), 0.0, true) : kAbsorbed;
}

// `lobe` chooses between the lobes, `u` within one.
BsdfSample sampleBsdf(Surface s, vec3 wo, float lobe, vec2 u) {
    float cosO = dot(wo, s.normal);
    if (needs(kNeedTransmission)) {
        float through = s.transmission * (1.0 - s.metallic);
        if (lobe < through) return sampleTransmission(s, wo, lobe / through);
        lobe = (lobe - through) / (1.0 - through);
    }
    mat3 world = frameAround(s.normal);
    vec3 wi;
    Lobes lobes = lobesOf(s, cosO);
    if (needs(kNeedSpecular) && lobe < lobes.specularShare) {
        if (isSmooth(s)) {
            wi = 2.0 * cosO * s.normal - wo;
            if (dot(wi, s.geometricNormal) <= 0.0) return kAbsorbed;
            return BsdfSample(wi, fresnelSchlick(lobes.f0, lobes.f90, cosO) / lobes.specularShare, 0.0, false);
        }
        vec3 o = wo * world;
        wi = world * reflect(-o, sampleGgxNormal(o, s.alpha, u));
    } else {
        float pdfLocal;
        wi = world * sampleCosineHemisphere(u, pdfLocal);
    }
    float pdf;
    vec3 value = evalBsdf(s, wo, wi, pdf);
    return pdf > 0.0 ? BsdfSample(wi, value / pdf, pdf, false) : kAbsorbed;
}

#endif
