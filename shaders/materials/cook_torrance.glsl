// The reflection model of Cook and Torrance ("A Reflectance Model for Computer Graphics", ACM TOG 1(1), 1982) with each
// factor as the kernel is specialised to it: D is GGX; G and F are choices.
#ifndef RAYLAB_COOK_TORRANCE_GLSL
#define RAYLAB_COOK_TORRANCE_GLSL

#include "materials/materials.glsl"

// Perceptual roughness: the surface carries its square.
float roughnessOf(Surface s) { return sqrt(s.alpha); }

// GGX alpha by the mapping chosen: the square of the roughness, or the roughness itself.
float distributionAlpha(Surface s) {
    return max(kAlphaMapping == kAlphaLinear ? roughnessOf(s) : s.alpha, kSmallestAlpha);
}

// Unpolarised reflectance of a metal that reflects `r` at normal incidence, its index by Gulbrandsen, "Artist Friendly
// Metallic Fresnel", JCGT 3(4), 2014, with a white edge tint: n = (1 - r) / (1 + r) and his k^2 = 4 r / (1 + r)^2, hence
// n^2 + k^2 = 1.
vec3 fresnelConductor(vec3 r, float cosTheta) {
    float c2 = cosTheta * cosTheta, s2 = 1.0 - c2;
    vec3 sum = 1.0 + r;
    vec3 k2 = 4.0 * r / (sum * sum);
    vec3 n2 = 1.0 - k2;
    vec3 difference = n2 - k2 - s2;
    vec3 a2b2 = sqrt(difference * difference + 4.0 * n2 * k2);
    vec3 twice = 2.0 * cosTheta * sqrt(max(0.5 * (a2b2 + difference), 0.0));
    vec3 perpendicular = (a2b2 + c2 - twice) / (a2b2 + c2 + twice);
    vec3 across = c2 * a2b2 + s2 * s2;
    return 0.5 * perpendicular * (1.0 + (across - twice * s2) / (across + twice * s2));
}

// Reflectance of the surface where the angle to its (micro)normal has this cosine.
vec3 reflectanceAt(Surface s, float cosTheta) {
    if (kFresnel == kFresnelSchlick) return fresnelSchlick(reflectance0(s), reflectance90(s), cosTheta);
    float cosT;
    float dielectric = s.specular * fresnelDielectric(cosTheta, s.ior, cosT);
    return mix(vec3(dielectric), fresnelConductor(s.baseColor, cosTheta), s.metallic);
}

float schlickDenominator(float cosTheta, float k) { return cosTheta * (1.0 - k) + k; }

// G / (4 cosO cosI). Smith's function as Heitz has it (JCGT 3(2), 2014), height-correlated or not; or Schlick's
// approximation of it (1994) with k = (r + 1)^2 / 8 for punctual light or r^2 / 2 for light from everywhere (Karis, "Real
// Shading in Unreal Engine 4", 2013).
float visibility(float cosO, float cosI, float roughness, float alpha) {
    if (kGeometry == kGeometrySmithCorrelated) return ggxMasking(cosO, cosI, alpha) / (4.0 * cosO * cosI);
    if (kGeometry == kGeometrySmithSeparable)
        return 0.25 / ((1.0 + ggxLambda(cosO, alpha)) * (1.0 + ggxLambda(cosI, alpha)) * cosO * cosI);
    float k = kGeometry == kGeometrySchlickIbl ? 0.5 * roughness * roughness
                                               : 0.125 * (roughness + 1.0) * (roughness + 1.0);
    return 0.25 / (schlickDenominator(cosO, k) * schlickDenominator(cosI, k));
}

// Whether the specular lobe is a mirror image, in which no punctual light is seen.
bool isMirror(Surface s) { return s.alpha < frame.mirrorAlpha; }

// (k_d c / pi + D F G / (4 cosO cosI)) cosI, k_d = (1 - F)(1 - metallic). Both directions world, unit.
vec3 evalCookTorrance(Surface s, vec3 wo, vec3 wi) {
    float cosO = dot(wo, s.normal), cosI = dot(wi, s.normal);
    if (cosI <= 0.0 || cosO <= 0.0 || dot(wi, s.geometricNormal) <= 0.0) return vec3(0.0);
    vec3 value = evalLambert(diffuseAlbedo(s));
    if (needs(kNeedSpecular)) {
        vec3 h = normalize(wo + wi);
        vec3 fresnel = reflectanceAt(s, dot(wo, h));
        value *= 1.0 - fresnel;
        if (!isMirror(s)) {
            float alpha = distributionAlpha(s);
            value += fresnel * ggxDistribution(dot(h, s.normal), alpha) * visibility(cosO, cosI, roughnessOf(s), alpha);
        }
    }
    return opaqueShare(s) * cosI * value;
}

#endif
