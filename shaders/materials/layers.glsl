// What lies on the base: sheen, and a clear coat above it. Below a layer the lobes are scaled by what it does not reflect
// of the light from the direction of which it reflects more: reciprocal, and never more light than there was.
#ifndef RAYLAB_LAYERS_GLSL
#define RAYLAB_LAYERS_GLSL

#include "materials/facets.glsl"

const float kClearcoatF0 = 0.04;  // KHR_materials_clearcoat: ior 1.5

vec3 coatNormal(Surface s) { return needs(kNeedCoatNormals) ? s.coatNormal : s.normal; }

bool isCoatSmooth(Surface s) { return s.lobes.clearcoatAlpha < kSmallestAlpha; }

float clearcoatFresnel(float cosTheta) { return fresnelSchlick(vec3(kClearcoatF0), 1.0, cosTheta).x; }

// What the coat reflects of light from above it, at the cosine to its own normal; from below its horizon, nothing gets in.
float clearcoatAlbedo(Surface s, vec3 w) {
    float cosTheta = dot(w, coatNormal(s));
    if (needs(kNeedCoatNormals) && cosTheta <= 0.0) return s.lobes.clearcoat;
    return s.lobes.clearcoat * schlickAlbedo(vec3(kClearcoatF0), 1.0, facetAlbedo(cosTheta, s.lobes.clearcoatAlpha)).x;
}

// f of the clear coat without a mirror's, as of light that comes at the base's cosine; and its density.
float evalClearcoat(Surface s, vec3 wo, vec3 wi, out float pdf) {
    pdf = 0.0;
    if (isCoatSmooth(s)) return 0.0;
    vec3 n = coatNormal(s);
    float cosO = dot(wo, n), cosI = dot(wi, n);
    if (needs(kNeedCoatNormals) && cosI <= 0.0) return 0.0;
    vec3 h = normalize(wo + wi);
    float alpha = s.lobes.clearcoatAlpha;
    Facets facets = Facets(ggxDistribution(dot(h, n), alpha), ggxLambda(cosO, alpha), ggxLambda(cosI, alpha));
    pdf = pdfFacetReflection(facets, cosO);
    float value = s.lobes.clearcoat * clearcoatFresnel(dot(wo, h)) * evalFacetReflection(facets, cosO, cosI);
    return needs(kNeedCoatNormals) ? value * cosI / dot(wi, s.normal) : value;
}

// Fibres that stand out of the surface (Estevez, Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH course, 2017).
float sheenAlpha(Surface s) { return max(s.lobes.sheenRoughness * s.lobes.sheenRoughness, kSmallestSheenAlpha); }

float sheenFit(float x, float sharpness) {
    float a = mix(21.5473, 25.3245, sharpness), b = mix(3.82987, 3.32435, sharpness), c = mix(0.19823, 0.16801, sharpness);
    float d = mix(-1.97760, -1.27393, sharpness), e = mix(-4.32054, -4.85967, sharpness);
    return a / (1.0 + b * pow(x, c)) + d * x + e;
}

float sheenLambda(float cosTheta, float alpha) {
    float sharpness = (1.0 - alpha) * (1.0 - alpha);
    float x = cosTheta < 0.5 ? cosTheta : 1.0 - cosTheta;
    float fit = sheenFit(max(x, 1e-6), sharpness);
    return exp(cosTheta < 0.5 ? fit : 2.0 * sheenFit(0.5, sharpness) - fit);
}

vec3 evalSheen(Surface s, vec3 wo, vec3 wi) {
    float cosO = dot(wo, s.normal), cosI = dot(wi, s.normal);
    float cosH = dot(normalize(wo + wi), s.normal);
    float alpha = sheenAlpha(s);
    float sinH = sqrt(max(1.0 - cosH * cosH, 1e-7));
    float distribution = (2.0 + 1.0 / alpha) * pow(sinH, 1.0 / alpha) * 0.5 * kInvPi;
    float masking = 1.0 / (1.0 + sheenLambda(cosO, alpha) + sheenLambda(cosI, alpha));
    // The model reflects more than there is at grazing angles of straight fibres.
    float surplus = max(1.0, max(sheenAlbedo(cosO, s.lobes.sheenRoughness), sheenAlbedo(cosI, s.lobes.sheenRoughness)));
    masking /= surplus;
    return s.lobes.sheenColor * (distribution * masking / (4.0 * cosO * cosI));
}

float sheenReflected(Surface s, float cosTheta) {
    if (isBlack(s.lobes.sheenColor)) return 0.0;
    return maxComponent(s.lobes.sheenColor) * min(sheenAlbedo(cosTheta, s.lobes.sheenRoughness), 1.0);
}

#endif
