// Next event estimation: one light of one kind a call, and the densities that multiple importance sampling needs.
#ifndef RAYLAB_LIGHTS_GLSL
#define RAYLAB_LIGHTS_GLSL

#include "lib/environment.glsl"
#include "lib/surface.glsl"

struct LightSample {
    vec3 direction;  // unit, towards the light
    float distance;
    vec3 radiance;  // already divided by the density; zero: nothing to trace
    float pdf;      // over solid angle; 0 for a light that no ray can hit
};

const LightSample kNoLight = LightSample(vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 0.0);

// Density with which sampleEmissive chooses a point of this surface, over solid angle. Triangles are chosen by
// area x weight of their material, so the density over area is the weight over the total: no look-up by triangle.
float pdfEmissive(float emissionWeight, float distanceSquared, float cosLight) {
    return cosLight > 0.0 && emissionWeight > 0.0 ? frame.shareEmissive * emissionWeight / frame.emissiveTotal * distanceSquared / cosLight : 0.0;
}

LightSample sampleEmissive(vec3 position, vec2 choice, vec2 u) {
    uint index = min(uint(choice.x * float(frame.emissiveCount)), frame.emissiveCount - 1u);
    uvec4 w0 = texelFetch(emissiveWords, int(index * kWordsEmissive));
    uint alias = texelFetch(emissiveWords, int(index * kWordsEmissive + 1u)).w;
    index = choice.y < uintBitsToFloat(w0.w) ? index : alias;
    int at = int(index * kWordsEmissive);
    vec3 p0 = uintBitsToFloat(texelFetch(emissiveWords, at).xyz);
    vec3 e1 = uintBitsToFloat(texelFetch(emissiveWords, at + 1).xyz);
    uvec4 w2 = texelFetch(emissiveWords, at + 2);
    uvec4 w3 = texelFetch(emissiveWords, at + 3);
    vec2 b = sampleTriangle(u);
    vec3 toLight = p0 + b.x * e1 + b.y * uintBitsToFloat(w2.xyz) - position;
    float distanceSquared = dot(toLight, toLight);
    if (distanceSquared <= 0.0) return kNoLight;
    float distance = sqrt(distanceSquared);
    vec3 direction = toLight / distance;
    float cosLight = -uintBitsToFloat(w3.z) * dot(normalize(cross(e1, uintBitsToFloat(w2.xyz))), direction);
    MaterialData material = loadMaterial(w2.w);
    if ((material.flags & kMaterialDoubleSided) != 0u) cosLight = abs(cosLight);
    float pdf = pdfEmissive(material.emissionWeight, distanceSquared, cosLight);
    if (pdf <= 0.0) return kNoLight;
    vec3 emission = material.emission;
    if (needs(kNeedTextures) && material.emissionTexture != kNoTextureIndex) {
        uvec4 indices = texelFetch(triangleWords, int(loadInstanceHeader(w3.x).firstPrimitive + w3.y));
        emission *= sampleTextureSharp(material.emissionTexture, triangleUv(indices, b)).rgb;
    }
    return LightSample(direction, distance, emission / pdf, pdf);
}

// Light `index` as it reaches `position`. `probability`: with which samplePunctual chooses it.
LightSample punctualLight(vec3 position, uint index, out float probability) {
    int at = int(index * kWordsPunctual);
    uvec4 w0 = texelFetch(punctualWords, at);
    vec3 axis = uintBitsToFloat(texelFetch(punctualWords, at + 1).xyz);
    vec3 intensity = uintBitsToFloat(texelFetch(punctualWords, at + 2).xyz);
    vec4 rest = uintBitsToFloat(texelFetch(punctualWords, at + 3));
    probability = rest.x;
    if (w0.w == kPunctualDirectional) return LightSample(-axis, kInfinity, intensity, 0.0);
    vec3 toLight = uintBitsToFloat(w0.xyz) - position;
    float distanceSquared = dot(toLight, toLight);
    if (distanceSquared <= 0.0) return kNoLight;
    float distance = sqrt(distanceSquared);
    vec3 direction = toLight / distance;
    if (w0.w == kPunctualSpot) {
        float falloff = clamp(dot(-direction, axis) * rest.y + rest.z, 0.0, 1.0);
        intensity *= falloff * falloff;
    }
    return LightSample(direction, distance, intensity / distanceSquared, 0.0);
}

LightSample samplePunctual(vec3 position, vec2 choice) {
    uint index = min(uint(choice.x * float(frame.punctualCount)), frame.punctualCount - 1u);
    float threshold = uintBitsToFloat(texelFetch(punctualWords, int(index * kWordsPunctual + 1u)).w);
    uint alias = texelFetch(punctualWords, int(index * kWordsPunctual + 2u)).w;
    float probability;
    LightSample light = punctualLight(position, choice.y < threshold ? index : alias, probability);
    light.radiance /= frame.sharePunctual * probability;
    return light;
}

LightSample sampleSky(vec2 choice, vec2 u) {
    vec3 direction = sampleEnvironment(choice, u);
    float pdf;
    vec3 radiance = environmentRadiance(direction, pdf);
    pdf *= frame.shareEnvironment;
    return pdf > 0.0 ? LightSample(direction, kInfinity, radiance / pdf, pdf) : kNoLight;
}

// `kind` chooses between the kinds of light; `choice` within a kind; `u` on the light.
LightSample sampleLight(vec3 position, float kind, vec2 choice, vec2 u) {
    if (needs(kNeedEmissive) && kind < frame.shareEmissive) return sampleEmissive(position, choice, u);
    kind -= frame.shareEmissive;
    if (needs(kNeedPunctual) && kind < frame.sharePunctual) return samplePunctual(position, choice);
    if (needs(kNeedEnvironment) && frame.shareEnvironment > 0.0) return sampleSky(choice, u);
    return kNoLight;
}

#endif
