// From a hit to all that shading needs, in world space. Reads (instance, primitive, barycentrics) alone, so that every
// traversal backend leads to the same surface.
#ifndef RAYLAB_SURFACE_GLSL
#define RAYLAB_SURFACE_GLSL

#include "lib/quadric_uv.glsl"
#include "lib/rounding.glsl"
#include "lib/sampling.glsl"
#include "lib/texture.glsl"
#include "trace/common.glsl"

layout(constant_id = kSpecOffset) const uint kOffset = 0;
layout(constant_id = kSpecOffsetEpsilon) const float kOffsetEpsilonLength = 1e-3;

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
    vec3 baseTexture;  // the colour that baseColor is multiplied by
    uint material;
    float emissionWeight;
    float eta;        // index on the far side over index on wo's side
    LobeData lobes;
    vec3 tangent;        // unit, of s.normal: along it the anisotropic roughness lies; kNeedAnisotropy alone
    float alphaTangent;  // GGX along it, alpha across
    vec3 coatNormal;     // as the normal, of the clear coat; kNeedCoatNormals alone
};

// Below this GGX alpha a lobe is narrower than floats resolve: it is a mirror.
const float kSmallestAlpha = 1.0e-3;

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
// object space (Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.8). `largest`: coordinates in
// object space. A triangle's vertices take the place of the weighted sum: they also bound the error of a neighbouring
// triangle's plane.
vec3 positionErrorBound(InstanceData data, vec3 largest) {
    if (!needs(kNeedTransforms)) return roundingBound(8) * largest;
    vec4 h = vec4(largest, 1.0);
    // A matrix between two is rounded, and so is its inverse.
    return roundingBound(needs(kNeedMotion) ? 40 : 14) *
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

// What a hit is a point of, in world space, before its material is read.
struct Patch {
    vec3 position;
    vec3 positionError;
    float distanceError;
    vec3 normal;   // unit, of the front
    vec3 shading;  // unit
    vec2 uv;
    vec3 edge1;  // where uv moves by uvEdge1
    vec3 edge2;
    vec2 uvEdge1;
    vec2 uvEdge2;
    vec4 tangent;  // not unit; zero: none. w: handedness
};

vec2 vertexUv(uint vertex) { return uintBitsToFloat(texelFetch(vertexWords, int(vertex * kWordsVertex + 1u)).xy); }

vec4 vertexTangent(uint vertex) { return decodeTangent(texelFetch(vertexWords, int(vertex * kWordsVertex + 1u)).z); }

Patch trianglePatch(Hit hit, InstanceData data) {
    uvec4 i = texelFetch(triangleWords, int(data.firstPrimitive + hit.primitive));
    uvec4 v0 = texelFetch(vertexWords, int(i.x * kWordsVertex));
    uvec4 v1 = texelFetch(vertexWords, int(i.y * kWordsVertex));
    uvec4 v2 = texelFetch(vertexWords, int(i.z * kWordsVertex));
    vec3 p0 = uintBitsToFloat(v0.xyz), p1 = uintBitsToFloat(v1.xyz), p2 = uintBitsToFloat(v2.xyz);
    vec2 b = hit.barycentrics;
    Patch p;
    p.edge1 = p1 - p0;
    p.edge2 = p2 - p0;
    vec3 n = cross(p.edge1, p.edge2);
    p.position = (1.0 - b.x - b.y) * p0 + b.x * p1 + b.y * p2;
    p.positionError = positionErrorBound(data, max(abs(p0), max(abs(p1), abs(p2))));
    if (needs(kNeedTransforms)) {
        p.position = transformPoint(data, p.position);
        n = transformNormal(data, n);
        p.edge1 = transformVector(data, p.edge1);
        p.edge2 = transformVector(data, p.edge2);
    }
    Roundings roundings = triangleRoundings(p.edge1, p.edge2, b, p.positionError);
    p.distanceError = roundings.distance;
    if (kOffset == kOffsetErrorBound) p.position += roundings.inset;
    p.normal = normalize(n);
    p.uv = p.uvEdge1 = p.uvEdge2 = vec2(0.0);
    if (needs(kNeedTextures)) {
        vec2 uv0 = vertexUv(i.x);
        p.uvEdge1 = vertexUv(i.y) - uv0;
        p.uvEdge2 = vertexUv(i.z) - uv0;
        p.uv = uv0 + b.x * p.uvEdge1 + b.y * p.uvEdge2;
    }
    p.shading = p.normal;
    if (needs(kNeedSmoothNormals) && (data.flags & kInstanceSmooth) != 0u) {
        vec3 n0 = decodeNormal(v0.w), n1 = decodeNormal(v1.w), n2 = decodeNormal(v2.w);
        vec3 interpolated = transformNormal(data, n0 + b.x * (n1 - n0) + b.y * (n2 - n0));
        if (dot(interpolated, interpolated) > 0.0) p.shading = normalize(interpolated);
    }
    p.tangent = vec4(0.0);
    if (needs(kNeedNormalMaps | kNeedAnisotropy)) {
        vec4 t0 = vertexTangent(i.x);
        vec3 t1 = vertexTangent(i.y).xyz, t2 = vertexTangent(i.z).xyz;
        p.tangent = vec4(t0.xyz + b.x * (t1 - t0.xyz) + b.y * (t2 - t0.xyz), t0.w);
    }
    return p;
}

// Newton steps that take a point near a quadric onto it, along the gradient: the distance along a ray is not known well
// enough (Pharr, Jakob, Humphreys, section 6.8.5). The second one is for rays from far away.
const int kQuadricSteps = 2;

Patch quadricPatch(Ray ray, Hit hit, InstanceData data) {
    int at = int((data.firstPrimitive + hit.primitive) * kWordsQuadric);
    vec4 w0 = uintBitsToFloat(texelFetch(quadricWords, at));
    uvec4 rest = texelFetch(quadricWords, at + 1);
    vec3 radii = w0.xyz;
    float zz = w0.w, z = uintBitsToFloat(rest.x), constant = uintBitsToFloat(rest.y);
    vec3 local = ray.origin + hit.t * ray.direction;
    if (needs(kNeedTransforms)) local = pointToObject(data, local);
    vec3 c = local / radii;
    vec3 gradient;
    for (int i = 0; i <= kQuadricSteps; ++i) {
        gradient = vec3(2.0 * c.xy, 2.0 * zz * c.z + z);
        float value = dot(c.xy, c.xy) + zz * c.z * c.z + z * c.z + constant;
        float steepness = dot(gradient, gradient);
        if (i < kQuadricSteps && steepness > 0.0) c -= value / steepness * gradient;
    }
    Patch p;
    p.position = c * radii;
    // The next ray's equation is set up at this size: its rounding is that of the whole quadric's coordinates.
    p.positionError = 2.0 * positionErrorBound(data, vec3(maxComponent(abs(c))) * radii);
    quadricDerivatives(c, rest.w != 0u, zz, z, uintBitsToFloat(rest.z), p.edge1, p.edge2);
    p.edge1 *= radii;
    p.edge2 *= radii;
    vec3 n = gradient / radii;
    if (needs(kNeedTransforms)) {
        p.position = transformPoint(data, p.position);
        n = transformNormal(data, n);
        p.edge1 = transformVector(data, p.edge1);
        p.edge2 = transformVector(data, p.edge2);
    }
    // The apex of a cone has no normal: along the axis is as good as any.
    p.normal = dot(n, n) > 0.0 ? normalize(n) : vec3(0.0, 0.0, 1.0);
    p.shading = p.normal;
    p.distanceError = roundingBound(4) * maxComponent(abs(p.position));
    p.uv = hit.barycentrics;
    p.uvEdge1 = vec2(1.0, 0.0);
    p.uvEdge2 = vec2(0.0, 1.0);
    p.tangent = vec4(gradient == vec3(0.0) ? vec3(0.0) : vec3(-c.y, c.x, 0.0) * radii, 1.0);
    return p;
}

// Along u and across it, in the plane whose normal is n; false where the mesh says nothing.
bool tangentFrame(InstanceData data, vec4 along, vec3 n, out vec3 tangent, out vec3 bitangent) {
    tangent = transformVector(data, along.xyz);
    tangent -= n * dot(n, tangent);
    if (dot(tangent, tangent) < 1e-20) return false;
    tangent = normalize(tangent);
    bitangent = cross(n, tangent) * ((data.flags & kInstanceMirrored) != 0u ? -along.w : along.w);
    return true;
}

vec3 mappedNormal(InstanceData data, uint texture, float scale, Patch at, float lod, float u) {
    vec3 n = at.shading;
    if (!needs(kNeedNormalMaps) || texture == kNoTextureIndex) return n;
    vec3 tangent, bitangent;
    if (!tangentFrame(data, at.tangent, n, tangent, bitangent)) return n;
    vec3 m = fetchMaterialTexture(texture, at.uv, lod, u).xyz * 2.0 - 1.0;
    m.xy *= scale;
    vec3 mapped = m.x * tangent + m.y * bitangent + m.z * n;
    return dot(mapped, mapped) > 0.0 ? normalize(mapped) : n;
}

// KHR_materials_anisotropy: the roughness along the tangent, which the material turns, grows to 1.
void setAnisotropy(inout Surface s, InstanceData data, vec4 along) {
    vec3 front = s.frontFace ? s.normal : -s.normal, tangent, bitangent;
    s.tangent = frameAround(s.normal)[0];
    s.alphaTangent = s.alpha;
    if (s.lobes.anisotropy <= 0.0) return;
    if (tangentFrame(data, along, front, tangent, bitangent))
        s.tangent = s.lobes.tangentCos * tangent + s.lobes.tangentSin * bitangent;
    s.alpha = max(s.alpha, kSmallestAlpha);
    s.alphaTangent = mix(s.alpha, 1.0, s.lobes.anisotropy * s.lobes.anisotropy);
}

// Red where there is a texture, else 1; and so on for the other channels.
vec4 factorTexture(uint texture, vec2 uv, float lod, float u) {
    return texture == kNoTextureIndex ? vec4(1.0) : fetchMaterialTexture(texture, uv, lod, u);
}

// The textures of KHR_materials_{clearcoat, sheen, anisotropy, specular, transmission}. A direction of anisotropy is turned by
// the material's own rotation.
void applyLobeTextures(inout Surface s, InstanceData data, Patch at, vec3 wo, float lod, float u) {
    LobeTextureData t = loadLobeTextures(s.material);
    if (needs(kNeedClearcoat)) {
        s.lobes.clearcoat *= factorTexture(t.clearcoat, s.uv, lod, u).r;
        float roughness = factorTexture(t.clearcoatRoughness, s.uv, lod, u).g;
        s.lobes.clearcoatAlpha *= roughness * roughness;
    }
    if (needs(kNeedCoatNormals)) {
        vec3 n = mappedNormal(data, t.clearcoatNormal, t.clearcoatNormalScale, at, lod, u);
        s.coatNormal = visibleNormal(s.frontFace ? n : -n, wo);
    }
    if (needs(kNeedSheen)) {
        s.lobes.sheenColor *= factorTexture(t.sheenColor, s.uv, lod, u).rgb;
        s.lobes.sheenRoughness *= factorTexture(t.sheenRoughness, s.uv, lod, u).a;
    }
    if (needs(kNeedAnisotropy) && t.anisotropy != kNoTextureIndex) {
        vec3 texel = fetchMaterialTexture(t.anisotropy, s.uv, lod, u).rgb;
        vec2 along = texel.xy * 2.0 - 1.0;
        along = dot(along, along) > 1e-8 ? normalize(along) : vec2(1.0, 0.0);
        vec2 rotation = vec2(s.lobes.tangentCos, s.lobes.tangentSin);
        s.lobes.tangentCos = along.x * rotation.x - along.y * rotation.y;
        s.lobes.tangentSin = along.x * rotation.y + along.y * rotation.x;
        s.lobes.anisotropy *= texel.b;
    }
    if (needs(kNeedSpecular)) s.specular *= factorTexture(t.specular, s.uv, lod, u).a;
    if (needs(kNeedSpecularTint)) s.lobes.specularColor *= factorTexture(t.specularColor, s.uv, lod, u).rgb;
    if (needs(kNeedTransmission)) s.transmission *= factorTexture(t.transmission, s.uv, lod, u).r;
}

// `ray`: the one that hit, of unit direction. `u`: rounds texture levels.
Surface surfaceAt(Ray ray, Hit hit, RayCone cone, float u) {
    vec3 wo = -ray.direction;
    InstanceData data = loadInstance(hit.instance);
    MaterialData material = loadMaterial(data.material);
    bool isQuadric = needs(kNeedQuadrics) && (data.flags & kInstanceQuadric) != 0u;
    Patch at;
    if (isQuadric)
        at = quadricPatch(ray, hit, data);
    else
        at = trianglePatch(hit, data);

    Surface s;
    s.position = at.position;
    s.positionError = at.positionError;
    s.distanceError = at.distanceError;
    s.uv = at.uv;
    s.frontFace = dot(at.normal, wo) >= 0.0;
    float lod = 0.0;
    if (needs(kNeedTextures))
        lod = coneLod(cone, at.edge1, at.edge2, at.uvEdge1, at.uvEdge2, abs(dot(at.normal, wo)));
    vec3 shading = mappedNormal(data, material.normalTexture, material.normalScale, at, lod, u);
    s.geometricNormal = s.frontFace ? at.normal : -at.normal;
    s.normal = visibleNormal(s.frontFace ? shading : -shading, wo);

    s.material = data.material;
    s.baseTexture = vec3(1.0);
    s.metallic = material.metallic;
    float roughness = material.roughness;
    s.emission = material.emission;
    if (needs(kNeedTextures)) {
        if (material.baseColorTexture != kNoTextureIndex)
            s.baseTexture = fetchMaterialTexture(material.baseColorTexture, s.uv, lod, u).rgb;
        if (needs(kNeedSpecular) && material.metallicRoughnessTexture != kNoTextureIndex) {
            vec4 mr = fetchMaterialTexture(material.metallicRoughnessTexture, s.uv, lod, u);
            roughness *= mr.g;
            s.metallic *= mr.b;
        }
        if (material.emissionTexture != kNoTextureIndex)
            s.emission *= sampleTextureSharp(material.emissionTexture, s.uv).rgb;
    }
    s.baseColor = material.baseColor * s.baseTexture;
    if (needs(kNeedSpecular) && s.metallic > 0.5) s.normal = reflectingNormal(s.normal, s.geometricNormal, wo);
    bool emits = s.frontFace || (material.flags & kMaterialDoubleSided) != 0u;
    s.emission = emits ? s.emission : vec3(0.0);
    // Light sampling knows triangles alone, and none that move.
    bool isSampled = !isQuadric && (!needs(kNeedMotion) || (data.flags & kInstanceMoves) == 0u);
    s.emissionWeight = isSampled ? material.emissionWeight : 0.0;
    s.alpha = roughness * roughness;
    s.transmission = material.transmission;
    s.ior = material.ior;
    s.specular = material.specular;
    s.thin = (material.flags & kMaterialThin) != 0u;
    s.eta = s.frontFace || s.thin ? s.ior : 1.0 / s.ior;
    s.lobes = loadLobes(s.material);
    s.coatNormal = s.normal;
    if (needs(kNeedLobeTextures | kNeedCoatNormals)) applyLobeTextures(s, data, at, wo, lod, u);
    if (needs(kNeedAnisotropy)) setAnisotropy(s, data, at.tangent);
    return s;
}

// Moved by the bounds of the rounding errors and no more: that of the position, and that of the distance at which this
// triangle or a coplanar neighbour would be hit again.
vec3 offsetByErrorBound(Surface s, float side) {
    float distance = dot(abs(s.geometricNormal), s.positionError) + s.distanceError;
    vec3 shift = side * distance * s.geometricNormal;
    vec3 p = s.position + shift;
    // To the next float away from the surface, lest rounding undoes the shift.
    ivec3 bits = floatBitsToInt(p);
    ivec3 away = ivec3(sign(shift) * sign(p));
    return mix(intBitsToFloat(bits + away), p, equal(p, vec3(0.0)));
}

// By 256 units in the last place along a normal of an axis, near the origin by 2^-16: Waechter, Binder, "A Fast and Robust
// Method for Avoiding Self-Intersection", Ray Tracing Gems, chapter 6, 2019.
vec3 offsetByUlps(vec3 p, vec3 normal) {
    const float kNearOrigin = 1.0 / 32.0;
    ivec3 ulps = ivec3(256.0 * normal * sign(p));
    return mix(intBitsToFloat(floatBitsToInt(p) + ulps), p + normal / 65536.0, lessThan(abs(p), vec3(kNearOrigin)));
}

// An origin on the side of the surface that `direction` leaves to.
vec3 offsetOrigin(Surface s, vec3 direction) {
    float side = dot(direction, s.geometricNormal) < 0.0 ? -1.0 : 1.0;
    if (kOffset == kOffsetUlp) return offsetByUlps(s.position, side * s.geometricNormal);
    if (kOffset == kOffsetEpsilon) return s.position + side * kOffsetEpsilonLength * s.geometricNormal;
    return offsetByErrorBound(s, side);
}

#endif
