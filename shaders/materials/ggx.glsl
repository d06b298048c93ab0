// GGX reflection (Walter et al. 2007), height-correlated Smith masking (Heitz, JCGT 3(2), 2014), Schlick's Fresnel,
// visible normals by spherical caps (Dupuy, Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023).
// Directions live in the shading frame, z along the normal; both above the surface.
#ifndef RAYLAB_GGX_GLSL
#define RAYLAB_GGX_GLSL

#include "lib/sampling.glsl"

// Below this the lobe is narrower than floats resolve: it is a mirror.
const float kSmallestAlpha = 1.0e-3;

float ggxDistribution(float cosH, float alpha) {
    float a2 = alpha * alpha;
    float d = cosH * cosH * (a2 - 1.0) + 1.0;
    return a2 * kInvPi / (d * d);
}

float ggxLambda(float cosTheta, float alpha) {
    float c2 = cosTheta * cosTheta;
    return 0.5 * (sqrt(1.0 + alpha * alpha * max(0.0, 1.0 - c2) / c2) - 1.0);
}

float ggxMasking(float cosO, float cosI, float alpha) {
    return 1.0 / (1.0 + ggxLambda(cosO, alpha) + ggxLambda(cosI, alpha));
}

vec3 fresnelSchlick(vec3 f0, float f90, float cosTheta) {
    float m = clamp(1.0 - cosTheta, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (vec3(f90) - f0) * (m2 * m2 * m);
}

vec3 sampleGgxNormal(vec3 wo, float alpha, vec2 u) {
    vec3 w = normalize(vec3(alpha * wo.xy, wo.z));
    float phi = 2.0 * kPi * u.x;
    float z = (1.0 - u.y) * (1.0 + w.z) - w.z;
    float r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + w;
    return normalize(vec3(alpha * h.xy, max(h.z, 0.0)));
}

// D G / (4 cosO cosI), to be multiplied by the Fresnel term.
float evalGgxReflection(float cosO, float cosI, float cosH, float alpha) {
    return ggxDistribution(cosH, alpha) * ggxMasking(cosO, cosI, alpha) / (4.0 * cosO * cosI);
}

// Density of the reflected direction when the normal is drawn by sampleGgxNormal.
float pdfGgxReflection(float cosO, float cosH, float alpha) {
    return ggxDistribution(cosH, alpha) / (4.0 * cosO * (1.0 + ggxLambda(cosO, alpha)));
}

#endif
