// From a hit to all that shading needs, in world space. Reads (instance, primitive, barycentrics) alone, so that every
// traversal backend leads to the same surface.
#ifndef RAYLAB_SURFACE_GLSL
#define RAYLAB_SURFACE_GLSL

#include "lib/sampling.glsl"
#include "lib/texture.glsl"
#include "trace/common.glsl"

// Width of the ray for texture filtering: grows by `spread` for each unit of distance.
struct RayCone {
    float width;
    float spread;
};

struct Surface {
    vec3 position;
    vec3 positionError;    // bound of the rounding error, by component
    float distanceError;   // bound of the rounding error of the distance to a triangle of this size
    vec3 geometricNormal;  // unit, on wo's side
    vec3 normal;           // shading normal, unit, on wo's side
    vec2 uv;
    bool frontFace;
    vec3 baseColor;
    float metallic;
    float alpha;  // GGX
    float transmission;
    float ior;
    float specular;
    bool thin;
    vec3 emission;  // towards wo
    float emissionWeight;
};

const float kMachineEpsilon = 5.9604644775390625e-8;
float roundingBound(int operations) {
    return float(operations) * kMachineEpsilon / (1.0 - float(operations) * kMachineEpsilon);
}

vec3 transformPoint(InstanceData data, vec3 p) {
    vec4 h = vec4(p, 1.0);
    return vec3(dot(data.objectToWorld0, h), dot(data.objectToWorld1, h), dot(data.objectToWorld2, h));
}

vec3 transformVector(InstanceData data, vec3 v) {
    return vec3(dot(data.objectToWorld0.xyz, v), dot(data.objectToWorld1.xyz, v), dot(data.objectToWorld2.xyz, v));
}

// Normals by the cofactor matrix, which needs no inverse and survives a determinant near zero.
vec3 transformNormal(InstanceData data, vec3 n) {
    vec3 r0 = data.objectToWorld0.xyz, r1 = data.objectToWorld1.xyz, r2 = data.objectToWorld2.xyz;
    vec3 t = vec3(dot(cross(r1, r2), n), dot(cross(r2, r0), n), dot(cross(r0, r1), n));
    return (data.flags & kInstanceMirrored) != 0u ? -t : t;
}

// Bound of the error of a point computed from barycentrics and, below an instance, of taking a ray's origin back into
// object space (Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.8). The vertices' largest
// coordinates take the place of the weighted sum: they also bound the error of a neighbouring triangle's plane.
vec3 positionErrorBound(InstanceData data, vec3 p0, vec3 p1, vec3 p2) {
    vec3 largest = max(abs(p0), max(abs(p1), abs(p2)));
    if (!needs(kNeedTransforms)) return roundingBound(8) * largest;
    vec4 h = vec4(largest, 1.0);
    return roundingBound(14) *
           vec3(dot(abs(data.objectToWorld0), h), dot(abs(data.objectToWorld1), h), dot(abs(data.objectToWorld2), h));
}

// Level of detail of a texture of one texel; sampleTexture's level is this plus log2 of the texture's size.
float coneLod(RayCone cone, vec3 e1, vec3 e2, vec2 d1, vec2 d2, float cosTheta) {
    float worldArea = length(cross(e1, e2));
    float uvArea = abs(d1.x * d2.y - d1.y * d2.x);
    return 0.5 * log2(max(uvArea, 1e-30) / max(worldArea, 1e-30)) + log2(max(cone.width, 1e-30) / max(cosTheta, 0.05));
}

vec4 fetchMaterialTexture(uint texture, vec2 uv, float lod, float u) {
    uvec2 size = texelFetch(textureWords, int(texture)).yz;
    return sampleTexture(texture, uv, lod + 0.5 * log2(float(size.x) * float(size.y)), u);
}

// Bends a shading normal just as far as needed for wo to be above it.
vec3 visibleNormal(vec3 n, vec3 wo) {
    float below = dot(n, wo);
    return below > 1e-3 ? n : normalize(n + (1e-3 - below) * wo);
}

// Bends a metal's shading normal until the mirror direction clears the surface: a metal that reflects into itself is black
// (Keller et al., "The Iray Light Transport Simulation and Rendering System", 2017).
vec3 reflectingNormal(vec3 n, vec3 geometric, vec3 wo) {
    vec3 mirrored = 2.0 * dot(wo, n) * n - wo;
    float height = dot(mirrored, geometric);
    return height >= 1e-2 ? n : normalize(wo + normalize(mirrored + (1e-2 - height) * geometric));
}

vec3 shadingNormal(InstanceData data, MaterialData material, uvec4 i, vec2 bary, uint n0, uint n1, uint n2, vec2 uv,
                   float lod, float u, vec3 geometric) {
    vec3 n = geometric;
    if ((data.flags & kInstanceSmooth) != 0u) {
        vec3 a = decodeNormal(n0), b = decodeNormal(n1), c = decodeNormal(n2);
        vec3 interpolated = transformNormal(data, a + bary.x * (b - a) + bary.y * (c - a));
        if (dot(interpolated, interpolated) > 0.0) n = normalize(interpolated);
    }
    if (!needs(kNeedNormalMaps) || material.normalTexture == kNoTextureIndex) return n;
    vec4 t0 = decodeTangent(texelFetch(vertexWords, int(i.x * kWordsVertex + 1u)).z);
    vec4 t1 = decodeTangent(texelFetch(vertexWords, int(i.y * kWordsVertex + 1u)).z);
    vec4 t2 = decodeTangent(texelFetch(vertexWords, int(i.z * kWordsVertex + 1u)).z);
    vec3 tangent = transformVector(data, t0.xyz + bary.x * (t1.xyz - t0.xyz) + bary.y * (t2.xyz - t0.xyz));
    tangent -= n * dot(n, tangent);
    if (dot(tangent, tangent) < 1e-20) return n;
    tangent = normalize(tangent);
    float handedness = (data.flags & kInstanceMirrored) != 0u ? -t0.w : t0.w;
    vec3 bitangent = cross(n, tangent) * handedness;
    vec3 m = fetchMaterialTexture(material.normalTexture, uv, lod, u).xyz * 2.0 - 1.0;
    m.xy *= material.normalScale;
    vec3 mapped = m.x * tangent + m.y * bitangent + m.z * n;
    return dot(mapped, mapped) > 0.0 ? normalize(mapped) : n;
}

// `wo`: unit, towards where the ray came from. `u`: rounds texture levels.
Surface surfaceAt(Hit hit, vec3 wo, RayCone cone, float u) {
    InstanceData data = loadInstance(hit.instance);
    MaterialData material = loadMaterial(data.material);
    uvec4 i = texelFetch(triangleWords, int(data.firstTriangle + hit.primitive));
    uvec4 v0 = texelFetch(vertexWords, int(i.x * kWordsVertex));
    uvec4 v1 = texelFetch(vertexWords, int(i.y * kWordsVertex));
    uvec4 v2 = texelFetch(vertexWords, int(i.z * kWordsVertex));
    vec3 p0 = uintBitsToFloat(v0.xyz), p1 = uintBitsToFloat(v1.xyz), p2 = uintBitsToFloat(v2.xyz);
    vec2 b = hit.barycentrics;

    Surface s;
    vec3 e1 = p1 - p0, e2 = p2 - p0;
    vec3 n = cross(e1, e2);
    vec3 local = (1.0 - b.x - b.y) * p0 + b.x * p1 + b.y * p2;
    s.position = local;
    s.positionError = positionErrorBound(data, p0, p1, p2);
    if (needs(kNeedTransforms)) {
        s.position = transformPoint(data, local);
        n = transformNormal(data, n);
        e1 = transformVector(data, e1);
        e2 = transformVector(data, e2);
    }
    s.distanceError = roundingBound(4) * max(maxComponent(abs(e1)), maxComponent(abs(e2)));
    n = normalize(n);
    s.frontFace = dot(n, wo) >= 0.0;
    s.uv = vec2(0.0);
    float lod = 0.0;
    if (needs(kNeedTextures)) {
        vec2 uv0 = uintBitsToFloat(texelFetch(vertexWords, int(i.x * kWordsVertex + 1u)).xy);
        vec2 uv1 = uintBitsToFloat(texelFetch(vertexWords, int(i.y * kWordsVertex + 1u)).xy);
        vec2 uv2 = uintBitsToFloat(texelFetch(vertexWords, int(i.z * kWordsVertex + 1u)).xy);
        s.uv = uv0 + b.x * (uv1 - uv0) + b.y * (uv2 - uv0);
        lod = coneLod(cone, e1, e2, uv1 - uv0, uv2 - uv0, abs(dot(n, wo)));
    }
    vec3 shading = n;
    if (needs(kNeedSmoothNormals) || needs(kNeedNormalMaps))
        shading = shadingNormal(data, material, i, b, v0.w, v1.w, v2.w, s.uv, lod, u, n);
    s.geometricNormal = s.frontFace ? n : -n;
    s.normal = visibleNormal(s.frontFace ? shading : -shading, wo);

    s.baseColor = material.baseColor;
    s.metallic = material.metallic;
    float roughness = material.roughness;
    s.emission = material.emission;
    if (needs(kNeedTextures)) {
        if (material.baseColorTexture != kNoTextureIndex)
            s.baseColor *= fetchMaterialTexture(material.baseColorTexture, s.uv, lod, u).rgb;
        if (needs(kNeedSpecular) && material.metallicRoughnessTexture != kNoTextureIndex) {
            vec4 mr = fetchMaterialTexture(material.metallicRoughnessTexture, s.uv, lod, u);
            roughness *= mr.g;
            s.metallic *= mr.b;
        }
        if (material.emissionTexture != kNoTextureIndex)
            s.emission *= sampleTextureSharp(material.emissionTexture, s.uv).rgb;
    }
    if (needs(kNeedSpecular) && s.metallic > 0.5) s.normal = reflectingNormal(s.normal, s.geometricNormal, wo);
    bool emits = s.frontFace || (material.flags & kMaterialDoubleSided) != 0u;
    s.emission = emits ? s.emission : vec3(0.0);
    s.emissionWeight = material.emissionWeight;
    s.alpha = roughness * roughness;
    s.transmission = material.transmission;
    s.ior = material.ior;
    s.specular = material.specular;
    s.thin = (material.flags & kMaterialThin) != 0u;
    return s;
}

// An origin on the side of the surface that `direction` leaves to, moved by the bounds of the rounding errors and no more:
// that of the position, and that of the distance at which this triangle or a coplanar neighbour would be hit again.
vec3 offsetOrigin(Surface s, vec3 direction) {
    float distance = dot(abs(s.geometricNormal), s.positionError) + s.distanceError;
    vec3 shift = distance * s.geometricNormal;
    shift = dot(direction, s.geometricNormal) < 0.0 ? -shift : shift;
    vec3 p = s.position + shift;
    // To the next float away from the surface, lest rounding undoes the shift.
    ivec3 bits = floatBitsToInt(p);
    ivec3 away = ivec3(sign(shift) * sign(p));
    return mix(intBitsToFloat(bits + away), p, equal(p, vec3(0.0)));
}

#endif
