// Descriptors of the scene and typed loads from them.
#ifndef RAYLAB_SCENE_BUFFERS_GLSL
#define RAYLAB_SCENE_BUFFERS_GLSL

#include "shared/bindings.h"
#include "shared/frame.h"
#include "shared/needs.h"
#include "shared/scene.h"

layout(constant_id = kSpecNeeds) const uint kNeeds = kNeedAll;
layout(constant_id = kSpecIntegrator) const uint kIntegrator = kIntegratorPath;
layout(constant_id = kSpecStackSize) const uint kStackSize = 64;
layout(constant_id = kSpecCount) const uint kCount = 0;
layout(constant_id = kSpecTriangle) const uint kTriangleTest = kTriangleWatertight;
layout(constant_id = kSpecFresnel) const uint kFresnel = kFresnelSchlick;
layout(constant_id = kSpecGeometry) const uint kGeometry = kGeometrySchlickDirect;
layout(constant_id = kSpecAlpha) const uint kAlphaMapping = kAlphaSquared;
layout(constant_id = kSpecShadows) const uint kShadows = kShadowsHard;
layout(constant_id = kSpecAttenuation) const uint kAttenuation = kAttenuationQuadratic;
layout(constant_id = kSpecHighlight) const uint kHighlight = kHighlightPhong;
layout(constant_id = kSpecReflection) const uint kReflection = kReflectionFresnel;
layout(constant_id = kSpecBeyond) const uint kBeyond = kBeyondBlack;
layout(constant_id = kSpecEnergy) const uint kEnergy = kEnergySingle;

// A macro, not a function: a constant in the file already, by which whole functions go before any is inlined.
#define needs(bits) ((kNeeds & (bits)) != 0u)

layout(set = 0, binding = kBindFrame, std140) uniform FrameBlock { FrameParams frame; };

layout(set = 0, binding = kBindNodes) uniform usamplerBuffer nodeWords;
layout(set = 0, binding = kBindTraceTriangles) uniform usamplerBuffer traceTriangleWords;
layout(set = 0, binding = kBindTraceInstances) uniform usamplerBuffer traceInstanceWords;
layout(set = 0, binding = kBindInstances) uniform usamplerBuffer instanceWords;
layout(set = 0, binding = kBindMotion) uniform usamplerBuffer motionWords;
layout(set = 0, binding = kBindTriangles) uniform usamplerBuffer triangleWords;
layout(set = 0, binding = kBindQuadrics) uniform usamplerBuffer quadricWords;
layout(set = 0, binding = kBindTraceQuadrics) uniform usamplerBuffer traceQuadricWords;
layout(set = 0, binding = kBindVertices) uniform usamplerBuffer vertexWords;
layout(set = 0, binding = kBindMaterials) uniform usamplerBuffer materialWords;
layout(set = 0, binding = kBindPhong) uniform usamplerBuffer phongWords;
layout(set = 0, binding = kBindAlbedo) uniform usamplerBuffer albedoWords;
layout(set = 0, binding = kBindLobes) uniform usamplerBuffer lobeWords;
layout(set = 0, binding = kBindLobeTextures) uniform usamplerBuffer lobeTextureWords;
layout(set = 0, binding = kBindTextures) uniform usamplerBuffer textureWords;
layout(set = 0, binding = kBindTexels) uniform usamplerBuffer texels;
layout(set = 0, binding = kBindEmissive) uniform usamplerBuffer emissiveWords;
layout(set = 0, binding = kBindPunctual) uniform usamplerBuffer punctualWords;
layout(set = 0, binding = kBindEnvironment) uniform samplerBuffer environmentTexels;
layout(set = 0, binding = kBindEnvironmentAlias) uniform usamplerBuffer environmentAlias;

InstanceData loadInstanceHeader(uint instance) {
    uvec4 w = texelFetch(instanceWords, int(instance * kWordsInstance + 3u));
    return InstanceData(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 1, 0), w.x, w.y, w.z, w.w);
}

// The moment, between 0 where the shutter opens and 1 where it closes, at which this invocation sees the scene.
float rayTime = 0.0;

// Rows of a matrix between both ends of the motion: points move in straight lines.
void moveInstance(uint instance, inout InstanceData data) {
    if ((data.flags & kInstanceMoves) == 0u) return;
    int at = int(instance * kWordsMotion);
    data.objectToWorld0 = mix(data.objectToWorld0, uintBitsToFloat(texelFetch(motionWords, at)), rayTime);
    data.objectToWorld1 = mix(data.objectToWorld1, uintBitsToFloat(texelFetch(motionWords, at + 1)), rayTime);
    data.objectToWorld2 = mix(data.objectToWorld2, uintBitsToFloat(texelFetch(motionWords, at + 2)), rayTime);
}

// As it stands at rayTime.
InstanceData loadInstance(uint instance) {
    InstanceData data = loadInstanceHeader(instance);
    if (needs(kNeedTransforms)) {
        int at = int(instance * kWordsInstance);
        data.objectToWorld0 = uintBitsToFloat(texelFetch(instanceWords, at));
        data.objectToWorld1 = uintBitsToFloat(texelFetch(instanceWords, at + 1));
        data.objectToWorld2 = uintBitsToFloat(texelFetch(instanceWords, at + 2));
        if (needs(kNeedMotion)) moveInstance(instance, data);
    }
    return data;
}

// Times the determinant: the vector of object space that is `v` in world space. By the cofactors.
vec3 timesInverse(InstanceData data, vec3 v) {
    vec3 r0 = data.objectToWorld0.xyz, r1 = data.objectToWorld1.xyz, r2 = data.objectToWorld2.xyz;
    return cross(r1, r2) * v.x + cross(r2, r0) * v.y + cross(r0, r1) * v.z;
}

float determinantOf(InstanceData data) {
    return dot(data.objectToWorld0.xyz, cross(data.objectToWorld1.xyz, data.objectToWorld2.xyz));
}

// A world-space point and vector in object space.
vec3 pointToObject(InstanceData data, vec3 p) {
    vec3 origin = vec3(data.objectToWorld0.w, data.objectToWorld1.w, data.objectToWorld2.w);
    return timesInverse(data, p - origin) / determinantOf(data);
}
vec3 vectorToObject(InstanceData data, vec3 v) { return timesInverse(data, v) / determinantOf(data); }

MaterialData loadMaterial(uint material) {
    int at = int(material * kWordsMaterial);
    vec4 a = uintBitsToFloat(texelFetch(materialWords, at));
    vec4 b = uintBitsToFloat(texelFetch(materialWords, at + 1));
    vec4 c = uintBitsToFloat(texelFetch(materialWords, at + 2));
    uvec4 d = texelFetch(materialWords, at + 3);
    vec4 df = uintBitsToFloat(d);
    uvec4 e = needs(kNeedTextures) ? texelFetch(materialWords, at + 4) : uvec4(kNoTextureIndex);
    return MaterialData(a.xyz, a.w, b.xyz, b.w, c.x, c.y, c.z, c.w, df.x, df.y, df.z, d.w, e.x, e.y, e.z, e.w);
}

// What the kernel does not need is as if the material did not have it.
LobeData loadLobes(uint material) {
    int at = int(material * kWordsLobe);
    vec4 a = vec4(1.0, 1.0, 1.0, 0.0), b = vec4(0.0);
    vec4 c = vec4(0.0);
    uvec4 d = uvec4(0u);
    if (needs(kNeedSpecularTint | kNeedClearcoat)) a = uintBitsToFloat(texelFetch(lobeWords, at));
    if (needs(kNeedSheen)) b = uintBitsToFloat(texelFetch(lobeWords, at + 1));
    if (needs(kNeedAbsorption | kNeedClearcoat)) c = uintBitsToFloat(texelFetch(lobeWords, at + 2));
    if (needs(kNeedAnisotropy | kNeedNesting)) d = texelFetch(lobeWords, at + 3);
    vec3 df = uintBitsToFloat(d.xyz);
    return LobeData(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, df.x, df.y, df.z, d.w);
}

LobeTextureData loadLobeTextures(uint material) {
    int at = int(material * kWordsLobeTextures);
    uvec4 a = texelFetch(lobeTextureWords, at);
    uvec4 b = texelFetch(lobeTextureWords, at + 1);
    uvec2 c = texelFetch(lobeTextureWords, at + 2).xy;
    return LobeTextureData(a.x, a.y, a.z, uintBitsToFloat(a.w), b.x, b.y, b.z, b.w, c.x, c.y, 0u, 0u);
}

PhongData loadPhong(uint material) {
    int at = int(material * kWordsPhong);
    vec4 a = uintBitsToFloat(texelFetch(phongWords, at));
    vec4 b = uintBitsToFloat(texelFetch(phongWords, at + 1));
    vec4 c = uintBitsToFloat(texelFetch(phongWords, at + 2));
    uvec4 d = texelFetch(phongWords, at + 3);
    return PhongData(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, uintBitsToFloat(d.xyz), d.w);
}

vec3 decodeOctahedral(vec2 e) {
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    float t = max(-n.z, 0.0);
    n.x += n.x >= 0.0 ? -t : t;
    n.y += n.y >= 0.0 ? -t : t;
    return normalize(n);
}

vec3 decodeNormal(uint packed) { return decodeOctahedral(unpackSnorm2x16(packed)); }
vec4 decodeTangent(uint packed) {
    return vec4(decodeOctahedral(unpackSnorm2x16(packed & ~1u)), (packed & 1u) != 0u ? 1.0 : -1.0);
}

#endif
