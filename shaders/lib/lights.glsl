// Next event estimation: one light of one kind a call, and the densities that multiple importance sampling needs.
#ifndef RAYLAB_LIGHTS_GLSL
#define RAYLAB_LIGHTS_GLSL

#include "lib/environment.glsl"
#include "lib/light_shapes.glsl"
#include "lib/light_tree.glsl"
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

// Density with which sampleLocal chooses the point of this surface that a ray from the receiver hits, over solid angle.
float pdfEmissive(Receiver receiver, Hit hit, float distanceSquared, float cosLight) {
    uint first = loadInstanceHeader(hit.instance).firstTrail;
    uvec2 trail = texelFetch(lightTrails, int(first + hit.primitive)).xy;
    float density = frame.shareEmissive * lightProbability(receiver, trail.x) * uintBitsToFloat(trail.y);
    return cosLight > 0.0 ? density * distanceSquared / cosLight : 0.0;
}

// A point of an emissive triangle, chosen evenly. `probability` of the triangle: of a tree alone.
LightSample emissiveLight(vec3 position, uint index, float probability, vec2 u) {
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
    vec3 normal = cross(e1, uintBitsToFloat(w2.xyz));
    float twiceArea = length(normal);
    float cosLight = -uintBitsToFloat(w3.z) * dot(normal / twiceArea, direction);
    MaterialData material = loadMaterial(w2.w);
    if ((material.flags & kMaterialDoubleSided) != 0u) cosLight = abs(cosLight);
    if (!(cosLight > 0.0)) return kNoLight;
    float pdf = kLightTree != 0u ? probability * 2.0 / twiceArea * distanceSquared / cosLight
                                 : pdfEmissive(material.emissionWeight, distanceSquared, cosLight);
    if (pdf <= 0.0) return kNoLight;
    vec3 emission = material.emission;
    if (needs(kNeedTextures) && material.emissionTexture != kNoTextureIndex) {
        uvec4 indices = texelFetch(triangleWords, int(loadInstanceHeader(w3.x).firstPrimitive + w3.y));
        emission *= sampleTextureSharp(material.emissionTexture, triangleUv(indices, b)).rgb;
    }
    return LightSample(direction, distance, emission / pdf, pdf);
}

LightSample sampleEmissive(vec3 position, vec2 choice, vec2 u) {
    uint index = min(uint(choice.x * float(frame.emissiveCount)), frame.emissiveCount - 1u);
    uvec4 w0 = texelFetch(emissiveWords, int(index * kWordsEmissive));
    uint alias = texelFetch(emissiveWords, int(index * kWordsEmissive + 1u)).w;
    index = choice.y < uintBitsToFloat(w0.w) ? index : alias;
    return emissiveLight(position, index, 1.0, u);
}

PunctualData loadPunctual(uint index) {
    int at = int(index * kWordsPunctual);
    uvec4 a = texelFetch(punctualWords, at);
    uvec4 b = texelFetch(punctualWords, at + 1), c = texelFetch(punctualWords, at + 2);
    vec4 d = uintBitsToFloat(texelFetch(punctualWords, at + 3));
    return PunctualData(uintBitsToFloat(a.xyz), a.w, uintBitsToFloat(b.xyz), uintBitsToFloat(b.w), uintBitsToFloat(c.xyz), c.w,
                        d.xyz, d.w);
}

// A light without a shape as it reaches `position`.
LightSample lightOfPoint(PunctualData light, vec3 position) {
    if (light.kind == kPunctualDirectional) return LightSample(-light.direction, kInfinity, light.intensity, 0.0);
    vec3 toLight = light.position - position;
    float distanceSquared = dot(toLight, toLight);
    if (distanceSquared <= 0.0) return kNoLight;
    float distance = sqrt(distanceSquared);
    vec3 direction = toLight / distance;
    float cosine = -dot(direction, light.direction);
    vec3 intensity = light.intensity;
    if (light.kind == kPunctualSpot) {
        float falloff = clamp(cosine * light.shape.x + light.shape.y, 0.0, 1.0);
        intensity *= falloff * falloff;
    }
    if (light.kind == kPunctualLambert) intensity *= max(0.0, cosine);
    return LightSample(direction, distance, intensity / distanceSquared, 0.0);
}

// Light `index` as it reaches `position`, for integrators that sum over all lights: these have no shape.
LightSample punctualLight(vec3 position, uint index) { return lightOfPoint(loadPunctual(index), position); }

// A point of the light, which was chosen with `probability`.
LightSample pointOfLight(PunctualData light, vec3 position, float probability, vec2 u) {
    if (needs(kNeedShapes) && light.kind >= kPunctualSphere) {
        ShapePoint at = sampleShape(light, position, u);
        float pdf = at.pdf * probability;
        return pdf > 0.0 ? LightSample(at.direction, at.distance, light.intensity / pdf, pdf) : kNoLight;
    }
    LightSample result = lightOfPoint(light, position);
    result.radiance /= probability;
    return result;
}

LightSample samplePunctual(vec3 position, vec2 choice, vec2 u) {
    uint index = min(uint(choice.x * float(frame.punctualCount)), frame.punctualCount - 1u);
    PunctualData light = loadPunctual(index);
    if (choice.y >= light.threshold) light = loadPunctual(light.alias);
    return pointOfLight(light, position, frame.sharePunctual * light.probability, u);
}

// Light of the shape, as a ray comes upon it, weighed against sampling it.
vec3 shapeRadiance(PunctualData light, ShapePoint at, float probability, float scatterPdf) {
    if (at.pdf <= 0.0) return vec3(0.0);
    return light.intensity * (scatterPdf > 0.0 ? misWeight(scatterPdf, at.pdf * probability) : 1.0);
}

// Light of all shapes that a ray comes upon within tMax. `receiver`: where the ray starts; `scatterPdf`: with which density
// it took its direction, 0 where no light sample competes with it; `absorption`: of the medium that it passes.
vec3 shapesAlong(Ray ray, float tMax, vec3 absorption, Receiver receiver, float scatterPdf) {
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < frame.shapedCount; ++i) {
        PunctualData light = loadPunctual(i);
        ShapePoint at = hitShape(light, ray);
        if (at.pdf <= 0.0 || at.distance >= tMax) continue;
        float probability = frame.sharePunctual * light.probability;
        if (kLightTree != 0u && scatterPdf > 0.0)
            probability = frame.shareEmissive * lightProbability(receiver, texelFetch(lightTrails, int(i)).x);
        vec3 radiance = shapeRadiance(light, at, probability, scatterPdf);
        sum += needs(kNeedAbsorption) ? radiance * exp(-absorption * at.distance) : radiance;
    }
    if (tMax < kInfinity || (needs(kNeedAbsorption) && !isBlack(absorption))) return sum;
    for (uint i = frame.punctualCount - frame.sunDiscCount; i < frame.punctualCount; ++i) {
        PunctualData light = loadPunctual(i);
        sum += shapeRadiance(light, hitSunDisc(light, ray), frame.sharePunctual * light.probability, scatterPdf);
    }
    return sum;
}

LightSample sampleSky(vec2 choice, vec2 u) {
    vec3 direction = sampleEnvironment(choice, u);
    float pdf;
    vec3 radiance = environmentRadiance(direction, pdf);
    pdf *= frame.shareEnvironment;
    return pdf > 0.0 ? LightSample(direction, kInfinity, radiance / pdf, pdf) : kNoLight;
}

// A light of the tree.
LightSample sampleLocal(Receiver receiver, vec2 choice, vec2 u) {
    float probability;
    uint light = chooseLight(receiver, choice, probability);
    if (probability <= 0.0) return kNoLight;
    probability *= frame.shareEmissive;
    if (needs(kNeedEmissive) && (!needs(kNeedPunctual) || light < frame.emissiveCount))
        return emissiveLight(receiver.position, light, probability, u);
    return pointOfLight(loadPunctual(light - frame.emissiveCount), receiver.position, probability, u);
}

// `kind` chooses between the kinds of light; `choice` within a kind; `u` on the light.
LightSample sampleLight(Receiver receiver, float kind, vec2 choice, vec2 u) {
    bool isLocal = (kLightTree != 0u || needs(kNeedEmissive)) && kind < frame.shareEmissive;
    if (kLightTree != 0u && isLocal) return sampleLocal(receiver, choice, u);
    if (isLocal) return sampleEmissive(receiver.position, choice, u);
    kind -= frame.shareEmissive;
    if (needs(kNeedPunctual) && kind < frame.sharePunctual) return samplePunctual(receiver.position, choice, u);
    if (needs(kNeedEnvironment) && frame.shareEnvironment > 0.0) return sampleSky(choice, u);
    return kNoLight;
}

#endif
