// The scene as the kernels read it. Every struct is a whole number of 16-byte words, because the kernels fetch uvec4s
// from texel buffers: on lavapipe a load costs by its number, not by its width.
#ifndef RAYLAB_SHARED_SCENE_H
#define RAYLAB_SHARED_SCENE_H

#include "types.h"

RAYLAB_SHARED_BEGIN

// Traversal: a triangle in leaf order, world space in the merged tree, object space below an instance.
// Kernels read it as the triangle test wants it (engine/render/triangle_record.h): three words, or four.
struct TraceTriangle {
    vec3 p0;
    uint instance;  // of 30 bits; kInheritInstance: the instance whose tree this is
    vec3 p1;
    uint primitive;  // index within its mesh
    vec3 p2;
    uint opacity;  // of 16 microtriangles, two bits each: kOpacity...
};
RAYLAB_CHECK(TraceTriangle, 48);
// A slot that holds a quadric instead: the first component of its first word is its index among the TraceQuadrics.
RAYLAB_CONST uint kSlotIsQuadric = 0x40000000u;  // in `instance`
RAYLAB_CONST uint kInheritInstance = 0x3fffffffu;  // in a Candidate: no hit yet
RAYLAB_CONST uint kInstanceMask = 0x3fffffffu;
RAYLAB_CONST uint kBlockIsLeaf = 0x80000000u;  // bvh4b: in the last component of a block's first word

// Opacity of a microtriangle of a triangle that is cut into 16 (Gruen et al., "Sub-Triangle Opacity Masks for Faster Ray
// Tracing of Transparent Objects", I3D 2020).
RAYLAB_CONST uint kOpacityUnknown = 0u;  // a hit must pass acceptsCandidate()
RAYLAB_CONST uint kOpacityTransparent = 1u;
RAYLAB_CONST uint kOpacityOpaque = 2u;
RAYLAB_CONST uint kAllOpaque = 0xaaaaaaaau;

// Triangle tests, in the order of triangleTests() in engine/render/triangle_record.cpp.
RAYLAB_CONST uint kTriangleMinimal = 0u;
RAYLAB_CONST uint kTrianglePrecomputed = 1u;
RAYLAB_CONST uint kTriangleBaldwinWeber = 2u;
RAYLAB_CONST uint kTriangleWatertight = 3u;

// Traversal: a leaf of the tree over instances. Rows of the 3x4 matrix world to object.
struct TraceInstance {
    vec4 worldToObject0;
    vec4 worldToObject1;
    vec4 worldToObject2;
    vec3 gridOrigin;
    uint root;  // child reference of the tree's root node
    vec3 gridStep;
    uint instance;
    uint firstSlot;  // range of TraceTriangles: of the tree
    uint slotCount;
    uint opaqueSlots;    // hardware tracers: triangles that need no alpha test come first
    uint triangleSlots;  // hardware tracers: then the others, then quadrics
};
RAYLAB_CHECK(TraceInstance, 96);
RAYLAB_CONST uint kWordsTraceInstance = 6;
// Hardware tracers: which of the structures of a tree an instance in the top level shows, in the low bits of its custom index.
RAYLAB_CONST uint kStructureKindBits = 2u;
RAYLAB_CONST uint kStructureOpaque = 0u;
RAYLAB_CONST uint kStructureAlpha = 1u;
RAYLAB_CONST uint kStructureQuadrics = 2u;

// Traversal: a quadric in the canonical space X^2 + Y^2 + zz Z^2 + z Z + constant = 0 (engine/scene/quadric.h). Rows of the
// 3x4 matrix from the space of its tree.
struct TraceQuadric {
    vec4 toCanonical0;
    vec4 toCanonical1;
    vec4 toCanonical2;
    float zz;
    float z;
    float constant;
    float clipLow;
    float clipHigh;
    uint isEllipsoid;  // texture coordinates by latitude, not by height
    uint padding0;
    uint padding1;
};
RAYLAB_CHECK(TraceQuadric, 80);
RAYLAB_CONST uint kWordsTraceQuadric = 5;

// Shading: a quadric of a mesh; the same form in coordinates over the radii.
struct QuadricData {
    vec3 radii;
    float zz;
    float z;
    float constant;
    float height;  // between the clip planes, canonical
    uint isEllipsoid;
};
RAYLAB_CHECK(QuadricData, 32);
RAYLAB_CONST uint kWordsQuadric = 2;

// Shading: an instance of a mesh. Rows of the 3x4 matrix object to world.
struct InstanceData {
    vec4 objectToWorld0;
    vec4 objectToWorld1;
    vec4 objectToWorld2;
    uint firstPrimitive;  // into the triangles or the quadrics of all meshes
    uint material;
    uint flags;  // kInstance...
    uint padding;
};
RAYLAB_CHECK(InstanceData, 64);
RAYLAB_CONST uint kWordsInstance = 4;
RAYLAB_CONST uint kInstanceSmooth = 1u;    // vertices carry normals
RAYLAB_CONST uint kInstanceMirrored = 2u;  // negative determinant
RAYLAB_CONST uint kInstanceQuadric = 4u;   // of a mesh of quadrics

struct TriangleData {
    uint v0;
    uint v1;
    uint v2;
    uint padding;
};
RAYLAB_CHECK(TriangleData, 16);

struct VertexData {
    vec3 position;
    uint normal;  // octahedral, 2 x 16 bits
    float u;
    float v;
    uint tangent;  // octahedral, 16 + 15 bits, lowest bit: handedness
    uint padding;
};
RAYLAB_CHECK(VertexData, 32);
RAYLAB_CONST uint kWordsVertex = 2;

struct MaterialData {
    vec3 baseColor;
    float alpha;
    vec3 emission;
    float alphaCutoff;  // alphaTested by blending: kAlphaBlend
    float metallic;
    float roughness;
    float transmission;
    float ior;
    float specular;
    float normalScale;
    float emissionWeight;  // light sampling: density over area is emissionWeight / FrameParams.emissiveTotal
    uint flags;            // kMaterial...
    uint baseColorTexture;
    uint metallicRoughnessTexture;
    uint normalTexture;
    uint emissionTexture;
};
RAYLAB_CHECK(MaterialData, 80);
RAYLAB_CONST uint kWordsMaterial = 5;
RAYLAB_CONST uint kNoTextureIndex = 0xffffffffu;
RAYLAB_CONST float kAlphaBlend = -1.0f;
RAYLAB_CONST uint kMaterialDoubleSided = 1u;
RAYLAB_CONST uint kMaterialThin = 2u;

// What the Phong model knows of a material beside MaterialData (engine/scene/scene.h, PhongMaterial).
struct PhongData {
    vec3 diffuse;
    float exponent;
    vec3 specular;
    float reflection;
    vec3 mirror;
    float ior;  // kOpaqueIor and above: a metal
    vec3 tint;
    uint isGiven;  // 0: to be derived from the surface
};
RAYLAB_CHECK(PhongData, 64);
RAYLAB_CONST uint kWordsPhong = 4;
RAYLAB_CONST float kOpaqueIor = 10000.0f;
RAYLAB_CONST float kLargestExponent = 10000.0f;

struct TextureData {
    uint firstTexel;  // level 0; the others follow it
    uint width;
    uint height;
    uint flags;  // bits 0-1 wrap u, 2-3 wrap v, 4 sRGB, 8-12 number of levels
};
RAYLAB_CHECK(TextureData, 16);
RAYLAB_CONST uint kTextureSrgb = 16u;
RAYLAB_CONST uint kTextureLevelShift = 8;

// An emissive triangle in world space. Entry of an alias table (Walker 1977).
struct EmissiveData {
    vec3 p0;
    float threshold;
    vec3 edge1;
    uint alias;
    vec3 edge2;
    uint material;
    uint instance;
    uint primitive;
    float frontSign;  // frontSign * cross(edge1, edge2) points to the front
    uint padding;
};
RAYLAB_CHECK(EmissiveData, 64);
RAYLAB_CONST uint kWordsEmissive = 4;

RAYLAB_CONST uint kPunctualPoint = 0;
RAYLAB_CONST uint kPunctualDirectional = 1;
RAYLAB_CONST uint kPunctualSpot = 2;

struct PunctualData {
    vec3 position;
    uint kind;
    vec3 direction;  // unit, the way the light travels
    float threshold;
    vec3 intensity;
    uint alias;
    float probability;
    float spotScale;   // KHR_lights_punctual: clamp(cos * scale + offset)^2
    float spotOffset;
    uint padding;
};
RAYLAB_CHECK(PunctualData, 64);
RAYLAB_CONST uint kWordsPunctual = 4;

RAYLAB_SHARED_END
#endif
