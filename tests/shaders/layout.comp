#version 460
#extension GL_GOOGLE_include_directive : require
// Reads one of every struct that C++ and GLSL share, by the kernels' own loads where there are any, and writes its scalars
// in the order of their declaration. tests/unit/gpu_layout_test.cpp says what they must be.
#include "lib/light_tree.glsl"
#include "shared/denoise.h"
#include "shared/wavefront.h"

layout(local_size_x = 1) in;
layout(push_constant) uniform PushBlock { RenderPush push; };
layout(set = 0, binding = kBindFilm, std430) readonly buffer FilmBlock { FilmPixel film; };
layout(set = 0, binding = kBindRays, std430) readonly buffer RayBlock { RayData ray; };
layout(set = 0, binding = kBindHits, std430) readonly buffer HitBlock { HitData hit; };
layout(set = 0, binding = kBindCounts, std430) readonly buffer CountBlock { RayCounts counts; };
layout(set = 0, binding = 49, std430) readonly buffer TraceQuadricBlock { TraceQuadric traceQuadric; };
layout(set = 0, binding = 50, std430) readonly buffer QuadricBlock { QuadricData quadric; };
layout(set = 0, binding = 52, std430) readonly buffer MotionBlock { MotionData motion; };
layout(set = 0, binding = 40, std430) readonly buffer RaysPushBlock { RaysPush raysPush; };
layout(set = 0, binding = 41, std430) readonly buffer TraceTriangleBlock { TraceTriangle traceTriangle; };
layout(set = 0, binding = 42, std430) readonly buffer TraceInstanceBlock { TraceInstance traceInstance; };
layout(set = 0, binding = 43, std430) readonly buffer TriangleBlock { TriangleData triangle; };
layout(set = 0, binding = 44, std430) readonly buffer VertexBlock { VertexData vertex; };
layout(set = 0, binding = 45, std430) readonly buffer TextureBlock { TextureData textureData; };
layout(set = 0, binding = 46, std430) readonly buffer EmissiveBlock { EmissiveData emissive; };
layout(set = 0, binding = 47, std430) readonly buffer PunctualBlock { PunctualData punctual; };
layout(set = 0, binding = 51, std430) readonly buffer WavefrontPushBlock { WavefrontPush wavefrontPush; };
layout(set = 0, binding = 53, std430) readonly buffer DenoisePushBlock { DenoisePush denoisePush; };
layout(set = 0, binding = 48, std430) writeonly buffer ResultBlock { uint result[]; };

uint next = 0u;

void emit(uint v) { result[next++] = v; }
void emit(float v) { emit(floatBitsToUint(v)); }
void emit(vec3 v) {
    emit(v.x);
    emit(v.y);
    emit(v.z);
}
void emit(vec4 v) {
    emit(v.xyz);
    emit(v.w);
}

void emitFrame() {
    emit(frame.cameraPosition);
    emit(frame.pixelSpread);
    emit(frame.cameraRight);
    emit(frame.width);
    emit(frame.cameraUp);
    emit(frame.height);
    emit(frame.cameraForward);
    emit(frame.seed);
    emit(frame.tilesPerRow);
    emit(frame.maxDepth);
    emit(frame.rouletteDepth);
    emit(frame.traceInstanceCount);
    emit(frame.emissiveCount);
    emit(frame.punctualCount);
    emit(frame.environmentWidth);
    emit(frame.environmentHeight);
    emit(frame.shareEmissive);
    emit(frame.sharePunctual);
    emit(frame.shareEnvironment);
    emit(frame.emissiveTotal);
    emit(frame.environmentConstant);
    emit(frame.sceneDiagonal);
    emit(frame.gridOrigin);
    emit(frame.root);
    emit(frame.gridStep);
    emit(frame.hasUpperTree);
    emit(frame.sampleCount);
    emit(frame.strataWidth);
    emit(frame.filterRadius);
    emit(frame.lensRadius);
    emit(frame.focusDistance);
    emit(frame.clampRadiance);
    emit(frame.mirrorAlpha);
    emit(frame.aoDistance);
    emit(frame.aoRays);
    emit(frame.aoShare);
    emit(frame.shapedCount);
    emit(frame.shutter);
    emit(frame.lightGridOrigin);
    emit(frame.sunDiscCount);
    emit(frame.lightGridStep);
    emit(frame.inverseThroughputEnd);
    emit(frame.endPosition);
    emit(frame.padding1);
    emit(frame.endRight);
    emit(frame.padding2);
    emit(frame.endUp);
    emit(frame.padding3);
    emit(frame.endForward);
    emit(frame.padding4);
    emit(frame.ambient);
    emit(frame.threshold);
}

void emitBuffers() {
    emit(film.sumHi);
    emit(film.count);
    emit(film.sumLo);
    emit(film.nonFinite);
    emit(film.squareHi);
    emit(film.rays);
    emit(film.squareLo);
    emit(film.clamped);
    emit(push.firstTile);
    emit(push.firstRow);
    emit(push.firstSample);
    emit(push.sampleCount);
    emit(push.firstLane);
    emit(push.laneCount);
    emit(ray.origin);
    emit(ray.tMin);
    emit(ray.direction);
    emit(ray.tMax);
    emit(hit.t);
    emit(hit.u);
    emit(hit.v);
    emit(hit.instance);
    emit(hit.primitive);
    emit(counts.steps);
    emit(counts.nodes);
    emit(counts.boxesTested);
    emit(counts.boxesHit);
    emit(counts.primitivesTested);
    emit(counts.primitivesHit);
    emit(counts.instances);
    emit(counts.stackHigh);
    emit(raysPush.count);
    emit(raysPush.anyHit);
}

void emitTraversal() {
    emit(traceTriangle.p0);
    emit(traceTriangle.instance);
    emit(traceTriangle.p1);
    emit(traceTriangle.primitive);
    emit(traceTriangle.p2);
    emit(traceTriangle.opacity);
    emit(traceInstance.worldToObject0);
    emit(traceInstance.worldToObject1);
    emit(traceInstance.worldToObject2);
    emit(traceInstance.gridOrigin);
    emit(traceInstance.root);
    emit(traceInstance.gridStep);
    emit(traceInstance.instance);
    emit(traceInstance.firstSlot);
    emit(traceInstance.slotCount);
    emit(traceInstance.opaqueSlots);
    emit(traceInstance.triangleSlots);
    emit(traceQuadric.toCanonical0);
    emit(traceQuadric.toCanonical1);
    emit(traceQuadric.toCanonical2);
    emit(traceQuadric.zz);
    emit(traceQuadric.z);
    emit(traceQuadric.constant);
    emit(traceQuadric.clipLow);
    emit(traceQuadric.clipHigh);
    emit(traceQuadric.isEllipsoid);
    emit(traceQuadric.padding0);
    emit(traceQuadric.padding1);
}

void emitGeometry() {
    InstanceData instance = loadInstance(1u);
    emit(instance.objectToWorld0);
    emit(instance.objectToWorld1);
    emit(instance.objectToWorld2);
    emit(instance.firstPrimitive);
    emit(instance.material);
    emit(instance.flags);
    emit(instance.firstTrail);
    emit(motion.endToWorld0);
    emit(motion.endToWorld1);
    emit(motion.endToWorld2);
    emit(triangle.v0);
    emit(triangle.v1);
    emit(triangle.v2);
    emit(triangle.padding);
    emit(vertex.position);
    emit(vertex.normal);
    emit(vertex.u);
    emit(vertex.v);
    emit(vertex.tangent);
    emit(vertex.padding);
    emit(quadric.radii);
    emit(quadric.zz);
    emit(quadric.z);
    emit(quadric.constant);
    emit(quadric.height);
    emit(quadric.isEllipsoid);
}

void emitMaterials() {
    MaterialData material = loadMaterial(1u);
    emit(material.baseColor);
    emit(material.alpha);
    emit(material.emission);
    emit(material.alphaCutoff);
    emit(material.metallic);
    emit(material.roughness);
    emit(material.transmission);
    emit(material.ior);
    emit(material.specular);
    emit(material.normalScale);
    emit(material.emissionWeight);
    emit(material.flags);
    emit(material.baseColorTexture);
    emit(material.metallicRoughnessTexture);
    emit(material.normalTexture);
    emit(material.emissionTexture);
    LobeData lobes = loadLobes(1u);
    emit(lobes.specularColor);
    emit(lobes.clearcoat);
    emit(lobes.sheenColor);
    emit(lobes.sheenRoughness);
    emit(lobes.absorption);
    emit(lobes.clearcoatAlpha);
    emit(lobes.anisotropy);
    emit(lobes.tangentCos);
    emit(lobes.tangentSin);
    emit(lobes.priority);
    LobeTextureData textures = loadLobeTextures(1u);
    emit(textures.clearcoat);
    emit(textures.clearcoatRoughness);
    emit(textures.clearcoatNormal);
    emit(textures.clearcoatNormalScale);
    emit(textures.sheenColor);
    emit(textures.sheenRoughness);
    emit(textures.anisotropy);
    emit(textures.specular);
    emit(textures.specularColor);
    emit(textures.transmission);
    PhongData phong = loadPhong(1u);
    emit(phong.diffuse);
    emit(phong.exponent);
    emit(phong.specular);
    emit(phong.reflection);
    emit(phong.mirror);
    emit(phong.ior);
    emit(phong.tint);
    emit(phong.isGiven);
    emit(textureData.firstTexel);
    emit(textureData.width);
    emit(textureData.height);
    emit(textureData.flags);
}

void emitLights() {
    emit(emissive.p0);
    emit(emissive.threshold);
    emit(emissive.edge1);
    emit(emissive.alias);
    emit(emissive.edge2);
    emit(emissive.material);
    emit(emissive.instance);
    emit(emissive.primitive);
    emit(emissive.frontSign);
    emit(emissive.padding);
    LightNodeData node = loadLightNode(1u);
    emit(node.loXY);
    emit(node.loZhiX);
    emit(node.hiYZ);
    emit(node.axis);
    emit(node.power);
    emit(node.cosines);
    emit(node.reference);
    emit(node.flags);
    emit(punctual.position);
    emit(punctual.kind);
    emit(punctual.direction);
    emit(punctual.threshold);
    emit(punctual.intensity);
    emit(punctual.alias);
    emit(punctual.shape);
    emit(punctual.probability);
}

void emitWavefront() {
    emit(wavefrontPush.slice.firstTile);
    emit(wavefrontPush.slice.firstRow);
    emit(wavefrontPush.slice.firstSample);
    emit(wavefrontPush.slice.sampleCount);
    emit(wavefrontPush.slice.firstLane);
    emit(wavefrontPush.slice.laneCount);
    emit(wavefrontPush.capacity);
    emit(wavefrontPush.lanes);
    emit(wavefrontPush.cellOrigin);
    emit(wavefrontPush.round);
    emit(wavefrontPush.cellScale);
    emit(wavefrontPush.pathsPerLane);
}

void emitDenoise() {
    emit(denoisePush.width);
    emit(denoisePush.height);
    emit(denoisePush.firstPixel);
    emit(denoisePush.pixelCount);
    emit(denoisePush.task);
    emit(denoisePush.spacing);
}

void main() {
    emitFrame();
    emitBuffers();
    emitTraversal();
    emitGeometry();
    emitMaterials();
    emitLights();
    emitWavefront();
    emitDenoise();
}
