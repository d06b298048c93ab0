// Descriptor set 0, declared once: what lies where, the workgroup, the specialisation constants.
#ifndef RAYLAB_SHARED_BINDINGS_H
#define RAYLAB_SHARED_BINDINGS_H

#include "types.h"

RAYLAB_SHARED_BEGIN

RAYLAB_CONST uint kBindFrame = 0;            // uniform buffer, FrameParams
RAYLAB_CONST uint kBindFilm = 1;             // dynamic storage buffer, FilmPixel (the band that is being rendered)
RAYLAB_CONST uint kBindNodes = 2;            // texel buffer, uvec4: nodes of the layout
RAYLAB_CONST uint kBindTraceTriangles = 3;   // texel buffer, uvec4: three or four a triangle, in the order of the slots
RAYLAB_CONST uint kBindTraceInstances = 4;   // texel buffer, uvec4: six an instance of a tree (TraceInstance)
RAYLAB_CONST uint kBindInstances = 5;        // texel buffer, uvec4: four an instance (InstanceData)
RAYLAB_CONST uint kBindTriangles = 6;        // texel buffer, uvec4: one a triangle of a mesh (vertex indices)
RAYLAB_CONST uint kBindVertices = 7;         // texel buffer, uvec4: two a vertex (VertexData)
RAYLAB_CONST uint kBindMaterials = 8;        // texel buffer, uvec4: five a material (MaterialData)
RAYLAB_CONST uint kBindTextures = 9;         // texel buffer, uvec4: one a texture (TextureData)
RAYLAB_CONST uint kBindTexels = 10;          // texel buffer, uint: RGBA8, all levels of all textures
RAYLAB_CONST uint kBindEmissive = 11;        // texel buffer, uvec4: four an emissive triangle (EmissiveData)
RAYLAB_CONST uint kBindPunctual = 12;        // texel buffer, uvec4: four a punctual light (PunctualData)
RAYLAB_CONST uint kBindEnvironment = 13;     // texel buffer, vec4: radiance, relative density of sampling
RAYLAB_CONST uint kBindEnvironmentAlias = 14;  // texel buffer, uvec2: threshold (float bits), alias
RAYLAB_CONST uint kBindRays = 15;            // texel buffer, vec4: two a ray (RayData): only in the ray-list kernels
RAYLAB_CONST uint kBindHits = 16;            // storage buffer, HitData: only in the ray-list kernels
RAYLAB_CONST uint kBindQuadrics = 17;       // texel buffer, uvec4: two a quadric of a mesh (QuadricData)
RAYLAB_CONST uint kBindTraceQuadrics = 18;  // texel buffer, uvec4: five a quadric of a tree (TraceQuadric)
RAYLAB_CONST uint kBindTopLevel = 19;       // acceleration structure: only in the kernels of the hardware tracers
RAYLAB_CONST uint kBindCounts = 20;         // storage buffer, RayCounts: only in the ray-list kernels
RAYLAB_CONST uint kBindBlueNoise = 21;       // texel buffer, uint: ranks of the mask, row by row
RAYLAB_CONST uint kBindPhong = 22;           // texel buffer, uvec4: four a material (PhongData)
RAYLAB_CONST uint kBindLightNodes = 23;      // texel buffer, uvec4: two a node of the tree over lights (LightNodeData)
RAYLAB_CONST uint kBindLightTrails = 24;     // texel buffer, uvec2: trail, 1 / area (float bits) of a primitive that emits
RAYLAB_CONST uint kBindSampleRates = 25;     // texel buffer, float: samples of a block of pixels over those of all, where it is adaptive
RAYLAB_CONST uint kBindAlbedo = 26;          // texel buffer, uvec4: directional albedos (engine/render/directional_albedo.h)
RAYLAB_CONST uint kBindLobes = 27;           // texel buffer, uvec4: four a material (LobeData)
RAYLAB_CONST uint kBindLobeTextures = 28;    // texel buffer, uvec4: three a material (LobeTextureData)
RAYLAB_CONST uint kBindMotion = 29;          // texel buffer, uvec4: three an instance (MotionData)
RAYLAB_CONST uint kBindPaths = 30;           // storage buffer, uvec4: states of paths (shared/wavefront.h): only in the wavefront's kernels
RAYLAB_CONST uint kBindQueues = 31;          // storage buffer, uint: their queues
RAYLAB_CONST uint kBindDenoiseLight = 32;    // texel buffer, vec4: light over colour, variance of its luminance: only in the denoiser
RAYLAB_CONST uint kBindDenoiseGuides = 33;   // texel buffer, vec4: normal and depth of the first hits
RAYLAB_CONST uint kBindDenoiseResult = 34;   // storage buffer, vec4: as the light

RAYLAB_CONST uint kTileSize = 8;                            // a workgroup renders a tile of 8 x 8 pixels
RAYLAB_CONST uint kWorkgroupSize = kTileSize * kTileSize;
RAYLAB_CONST uint kLanesPerBlock = 8;  // of a tile: 4 x 2 pixels (film/render_main.glsl)

RAYLAB_CONST uint kSpecNeeds = 0;       // which NEED_ bits the kernel contains
RAYLAB_CONST uint kSpecIntegrator = 1;  // IntegratorId
RAYLAB_CONST uint kSpecStackSize = 2;   // entries of the traversal stack: what this scene's trees can fill
RAYLAB_CONST uint kSpecCount = 3;       // 1: the traversal counts what it fetches
RAYLAB_CONST uint kSpecTriangle = 4;    // kTriangle...
RAYLAB_CONST uint kSpecFresnel = 5;     // kFresnel...
RAYLAB_CONST uint kSpecGeometry = 6;    // kGeometry...
RAYLAB_CONST uint kSpecAlpha = 7;       // kAlphaSquared or kAlphaLinear
RAYLAB_CONST uint kSpecShadows = 8;     // kShadows...
RAYLAB_CONST uint kSpecAttenuation = 9;  // kAttenuation...
RAYLAB_CONST uint kSpecHighlight = 10;   // kHighlight...
RAYLAB_CONST uint kSpecReflection = 11;  // kReflection...
RAYLAB_CONST uint kSpecBeyond = 12;      // kBeyond...
RAYLAB_CONST uint kSpecAntialias = 13;   // kAntialias...
RAYLAB_CONST uint kSpecEnergy = 14;      // kEnergy...
RAYLAB_CONST uint kSpecSampler = 16;    // kSampler...
RAYLAB_CONST uint kSpecFilter = 17;     // kFilter...
RAYLAB_CONST uint kSpecThinLens = 18;   // 1: rays start on a lens
RAYLAB_CONST uint kSpecClamp = 19;      // 1: samples are cut at frame.clampRadiance
RAYLAB_CONST uint kSpecOffsetEpsilon = 27;  // float: scene units
RAYLAB_CONST uint kSpecSlab = 28;           // kSlab...
RAYLAB_CONST uint kSpecOffset = 29;         // kOffset...
RAYLAB_CONST uint kSpecLightTree = 30;  // 1: lights are chosen by a tree
RAYLAB_CONST uint kSpecCameraMotion = 31;  // 1: the camera moves
RAYLAB_CONST uint kSpecAdaptive = 32;      // 1: blocks of pixels differ in their samples
RAYLAB_CONST uint kSpecStage = 40;         // kStage...: of the wavefront's kernels
RAYLAB_CONST uint kSpecQueueOrder = 41;    // kOrder...

// Slab tests of the software traversals.
RAYLAB_CONST uint kSlabPadded = 0;
RAYLAB_CONST uint kSlabPlain = 1;

// How far a ray starts off the surface that it leaves, in the order of the setting's choices.
RAYLAB_CONST uint kOffsetErrorBound = 0;
RAYLAB_CONST uint kOffsetUlp = 1;
RAYLAB_CONST uint kOffsetEpsilon = 2;

RAYLAB_SHARED_END
#endif
