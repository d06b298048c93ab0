// What passes through: a smooth or rough boundary of two dielectrics, or a thin sheet (KHR_materials_transmission). Rough:
// Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007.
#ifndef RAYLAB_GLASS_GLSL
#define RAYLAB_GLASS_GLSL

#include "materials/dielectric.glsl"
#include "materials/facets.glsl"

// Share of the light that meets glass, and of that which meets the opaque base.
float throughShare(Surface s) { return needs(kNeedTransmission) ? s.transmission * (1.0 - s.metallic) : 0.0; }
float opaqueShare(Surface s) { return 1.0 - throughShare(s); }

bool isRoughGlass(Surface s) { return needs(kNeedRoughTransmission) && !isSmooth(s); }

// Reflectance of a facet, of both faces where the sheet is thin.
float glassReflectance(Surface s, float cosTheta, out float cosT) {
    float r = fresnelDielectric(cosTheta, s.eta, cosT);
    return s.thin ? thinReflectance(r) : r;
}

// f |cosI| of rough glass, and the density of what is drawn from it. `wi` on either side.
vec3 evalRoughGlass(Surface s, vec3 wo, vec3 wi, out float pdf) {
    float cosO = dot(wo, s.normal), cosI = dot(wi, s.normal), cosT;
    bool refracts = cosI < 0.0 && !s.thin;
    // A sheet lets light through as it would mirror it, on the other side.
    vec3 reflected = cosI < 0.0 ? wi - 2.0 * cosI * s.normal : wi;
    vec3 h = normalize(refracts ? wo + s.eta * wi : wo + reflected);
    h = dot(h, s.normal) < 0.0 ? -h : h;
    float oh = dot(wo, h), ih = dot(wi, h);
    pdf = 0.0;
    if (oh <= 0.0 || (refracts && ih >= 0.0)) return vec3(0.0);
    Facets f = facetsAt(s, wo, wi, h);
    float r = glassReflectance(s, oh, cosT);
    float share = cosI < 0.0 ? 1.0 - r : r;
    vec3 tint = cosI < 0.0 ? s.baseColor : vec3(1.0);
    if (!refracts) {
        pdf = share * pdfFacetReflection(f, cosO);
        return tint * share * evalFacetReflection(f, cosO, abs(cosI)) * abs(cosI);
    }
    float path = oh + s.eta * ih;
    float visible = share * f.distribution * oh * -ih / (cosO * (1.0 + f.lambdaO) * path * path);
    pdf = visible * s.eta * s.eta;
    return tint * visible / (1.0 + f.lambdaI);
}

// The direction to the other side of a facet with normal h, and radiance's scale (Veach, section 5.2: divided by the square
// of the relative index where it enters a denser medium).
vec3 passedDirection(Surface s, vec3 wo, vec3 h, float cosT) {
    float oh = dot(wo, h);
    return normalize(-wo / s.eta + (oh / s.eta - cosT) * h);
}

BsdfSample sampleTransmission(Surface s, vec3 wo, float u) {
    float cosO = dot(wo, s.normal), cosT;
    float reflectance = glassReflectance(s, cosO, cosT);
    if (u < reflectance) {
        vec3 wi = 2.0 * cosO * s.normal - wo;
        return dot(wi, s.geometricNormal) > 0.0 ? BsdfSample(wi, vec3(1.0), 0.0, false) : kAbsorbed;
    }
    if (s.thin) return BsdfSample(-wo, s.baseColor, 0.0, true);
    vec3 wi = passedDirection(s, wo, s.normal, cosT);
    return dot(wi, s.geometricNormal) < 0.0 ? BsdfSample(wi, s.baseColor / (s.eta * s.eta), 0.0, true) : kAbsorbed;
}

// A direction of rough glass; zero where the facet sends light to the wrong side.
vec3 sampleRoughGlass(Surface s, vec3 wo, float lobe, vec2 u) {
    vec3 h = sampleFacet(s, shadingFrame(s), wo, u);
    float oh = dot(wo, h), cosT;
    if (oh <= 0.0) return vec3(0.0);
    bool reflects = lobe < glassReflectance(s, oh, cosT);
    vec3 wi = 2.0 * oh * h - wo;
    float side = dot(wi, s.normal);
    if (reflects) return side > 0.0 ? wi : vec3(0.0);
    if (s.thin) return side > 0.0 ? wi - 2.0 * side * s.normal : vec3(0.0);
    wi = passedDirection(s, wo, h, cosT);
    return dot(wi, s.normal) < 0.0 ? wi : vec3(0.0);
}

#endif
