// Warps of the unit square and the frames that they live in.
#ifndef RAYLAB_SAMPLING_GLSL
#define RAYLAB_SAMPLING_GLSL

const float kPi = 3.14159265358979;
const float kInvPi = 0.318309886183791;

float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); }
float maxComponent(vec3 v) { return max(v.x, max(v.y, v.z)); }
bool isBlack(vec3 v) { return maxComponent(v) <= 0.0; }

// Orthonormal basis without a branch (Duff et al., JCGT 6(1), 2017). Columns: tangent, bitangent, n.
mat3 frameAround(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// Cosine-weighted direction about +z (Malley).
vec3 sampleCosineHemisphere(vec2 u, out float pdf) {
    float r = sqrt(u.x);
    float phi = 2.0 * kPi * u.y;
    float z = sqrt(max(0.0, 1.0 - u.x));
    pdf = z * kInvPi;
    return vec3(r * cos(phi), r * sin(phi), z);
}

float pdfCosineHemisphere(float cosTheta) { return max(cosTheta, 0.0) * kInvPi; }

// Density 1 - |x| on [-1, 1].
float sampleTent(float u) { return u < 0.5 ? sqrt(2.0 * u) - 1.0 : 1.0 - sqrt(2.0 - 2.0 * u); }

// Uniform on the unit disc; concentric, so that strata keep their neighbours (Shirley, Chiu, JGT 2(3), 1997).
vec2 sampleDisc(vec2 u) {
    vec2 p = 2.0 * u - 1.0;
    if (p.x == 0.0 && p.y == 0.0) return p;
    bool wide = abs(p.x) > abs(p.y);
    float r = wide ? p.x : p.y;
    float phi = wide ? 0.25 * kPi * (p.y / p.x) : 0.5 * kPi - 0.25 * kPi * (p.x / p.y);
    return r * vec2(cos(phi), sin(phi));
}

// Uniform barycentrics of a triangle (weights of p1 and p2).
vec2 sampleTriangle(vec2 u) {
    float r = sqrt(u.x);
    return vec2(r * (1.0 - u.y), r * u.y);
}

// Power heuristic with exponent 2 (Veach, thesis, section 9.2.4), safe for large densities.
float misWeight(float pdf, float otherPdf) {
    float ratio = otherPdf / pdf;
    return 1.0 / (1.0 + ratio * ratio);
}

#endif
