// The model of Whitted's ray tracer: Phong's highlight ("Illumination for Computer Generated Pictures", CACM 18(6), 1975) or
// Blinn's ("Models of Light Reflection for Computer Synthesized Pictures", SIGGRAPH 1977), and a smooth part that is
// mirrored and refracted (Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980).
#ifndef RAYLAB_PHONG_GLSL
#define RAYLAB_PHONG_GLSL

#include "materials/materials.glsl"

// Rougher dielectrics show no mirror images, but highlights alone; smoother ones fade them in.
const float kRoughestMirror = 0.1;

// Exponent of Blinn's lobe that is as wide as GGX's (Walter et al., "Microfacet Models for Refraction through Rough
// Surfaces", EGSR 2007, section 5.2).
float exponentOfAlpha(float alpha) {
    return clamp(2.0 / max(alpha * alpha, 1e-8) - 2.0, 1.0, kLargestExponent);
}

// Highlight whose lobe carries what the surface reflects: F0 (p + 2) / 8, that of the normalised Blinn-Phong model
// (Akenine-Moller, Haines, Hoffman, "Real-Time Rendering", 4th ed., section 9.8.1); in its hue up to a largest component of 1.
vec3 highlightOf(vec3 f0, float exponent) {
    return f0 * min(0.125 * (exponent + 2.0), 1.0 / max(maxComponent(f0), 1e-6));
}

// For materials of metallic-roughness form. Metals are mirrors whatever their roughness, for they have no other colour.
PhongData phongOfSurface(Surface s) {
    float through = 1.0 - opaqueShare(s);
    PhongData p;
    p.diffuse = diffuseAlbedo(s) * (1.0 - through);
    p.exponent = exponentOfAlpha(s.alpha);
    p.specular = highlightOf(reflectance0(s), p.exponent);
    float r0 = (s.ior - 1.0) / (s.ior + 1.0);
    bool isMetal = s.metallic > 0.5;
    float polish = s.specular * clamp(1.0 - s.alpha / kRoughestMirror, 0.0, 1.0);
    p.mirror = isMetal ? s.baseColor * s.metallic : vec3(mix(polish, 1.0, through));
    p.tint = isMetal ? vec3(0.0) : min(s.baseColor, vec3(1.0)) * through;
    p.reflection = isMetal ? 1.0 : r0 * r0;
    p.ior = isMetal ? kOpaqueIor : s.ior;
    p.isGiven = 0u;
    return p;
}

PhongData phongAt(Surface s) {
    PhongData p = loadPhong(s.material);
    p.diffuse *= s.baseTexture;
    return p.isGiven != 0u ? p : phongOfSurface(s);
}

// Diffuse reflection and highlight of light from `wi` on a surface that it reaches: both relative to the radiance of a
// white diffuse surface that faces the light.
vec3 phongReflection(PhongData p, Surface s, vec3 wo, vec3 wi) {
    float cosL = dot(wi, s.normal);
    if (cosL <= 0.0 || dot(wi, s.geometricNormal) <= 0.0) return vec3(0.0);
    if (!needs(kNeedSpecular)) return p.diffuse * cosL;
    float cosine = kHighlight == kHighlightPhong ? dot(2.0 * cosL * s.normal - wi, wo) : dot(normalize(wi + wo), s.normal);
    return p.diffuse * cosL + p.specular * pow(max(cosine, 1e-20), p.exponent);
}

// What becomes of the light of the mirror direction and of the refracted one.
struct Shares {
    vec3 mirrored;
    vec3 refracted;
};

// `eta`: index on the far side over index on wo's side. By the exact Fresnel equations, of a metal by Schlick's
// approximation; or by the material's fixed share, all of it where there is no refracted direction.
Shares sharesOf(PhongData p, bool thin, float cosO, float eta) {
    if (p.ior >= kOpaqueIor) {
        // What reflects little at normal incidence is no metal: at grazing angles it is not a mirror either (Schueler, "An
        // Efficient and Physically Plausible Real-Time Shading Model", ShaderX7, 2009).
        float f90 = clamp(50.0 * maxComponent(p.mirror), 0.0, 1.0);
        bool fixedShare = kReflection == kReflectionFixed;
        return Shares(fixedShare ? p.mirror * p.reflection : fresnelSchlick(p.mirror, f90, cosO), vec3(0.0));
    }
    float cosT;
    float r = fresnelDielectric(cosO, eta, cosT);
    bool total = cosT == 0.0;
    if (thin) r = thinReflectance(r);
    if (kReflection == kReflectionFixed && !total) r = p.reflection;
    return Shares(p.mirror * r, p.tint * (1.0 - r));
}

// Index of refraction across the surface, seen from wo's side.
float relativeIndex(PhongData p, Surface s) { return s.frontFace || s.thin ? p.ior : 1.0 / p.ior; }

#endif
