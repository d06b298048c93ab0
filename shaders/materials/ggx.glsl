// GGX reflection (Walter et al. 2007), height-correlated Smith masking (Heitz, JCGT 3(2), 2014), Schlick's Fresnel,
// visible normals by spherical caps (Dupuy, Benyoub, "Sampling Visible GGX Normals with Spherical Caps", 2023).
// Directions live in the shading frame, z along the normal; both above the surface. An `alpha` of two components is
// anisotropic: along x and along y.
#ifndef RAYLAB_GGX_GLSL
#define RAYLAB_GGX_GLSL

#include "lib/sampling.glsl"

float ggxDistribution(float cosH, float alpha) {
    float a2 = alpha * alpha;
    float d = cosH * cosH * (a2 - 1.0) + 1.0;
    return a2 * kInvPi / (d * d);
}

float ggxDistribution(vec3 h, vec2 alpha) {
    vec3 v = vec3(h.xy / alpha, h.z);
    float d = dot(v, v);
    return kInvPi / (alpha.x * alpha.y * d * d);
}

float ggxLambda(float cosTheta, float alpha) {
    float c2 = cosTheta * cosTheta;
    return 0.5 * (sqrt(1.0 + alpha * alpha * max(0.0, 1.0 - c2) / c2) - 1.0);
}

float ggxLambda(vec3 w, vec2 alpha) {
    vec2 v = alpha * w.xy;
    return 0.5 * (sqrt(1.0 + dot(v, v) / (w.z * w.z)) - 1.0);
}

float ggxMasking(float cosO, float cosI, float alpha) {
    return 1.0 / (1.0 + ggxLambda(cosO, alpha) + ggxLambda(cosI, alpha));
}

vec3 fresnelSchlick(vec3 f0, float f90, float cosTheta) {
    float m = clamp(1.0 - cosTheta, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (vec3(f90) - f0) * (m2 * m2 * m);
}

vec3 sampleGgxNormal(vec3 wo, vec2 alpha, vec2 u) {
    vec3 w = normalize(vec3(alpha * wo.xy, wo.z));
    float phi = 2.0 * kPi * u.x;
    float z = (1.0 - u.y) * (1.0 + w.z) - w.z;
    float r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + w;
    return normalize(vec3(alpha * h.xy, max(h.z, 0.0)));
}

#endif
