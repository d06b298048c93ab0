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
    uint firstTrail;  // of its primitives, where they emit and there is a tree over lights
};
RAYLAB_CHECK(InstanceData, 64);
RAYLAB_CONST uint kWordsInstance = 4;
RAYLAB_CONST uint kInstanceSmooth = 1u;    // vertices carry normals
RAYLAB_CONST uint kInstanceMirrored = 2u;  // negative determinant
RAYLAB_CONST uint kInstanceQuadric = 4u;   // of a mesh of quadrics
RAYLAB_CONST uint kInstanceMoves = 8u;     // while the shutter is open

// Where an instance is when the shutter closes, as in InstanceData; of those that stand still too, where any moves.
struct MotionData {
    vec4 endToWorld0;
    vec4 endToWorld1;
    vec4 endToWorld2;
};
RAYLAB_CHECK(MotionData, 48);
RAYLAB_CONST uint kWordsMotion = 3;

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

RAYLAB_CONST uint kAlbedoCells = 32;  // of the tables of directional albedos, along each axis
RAYLAB_CONST float kSmallestSheenAlpha = 0.01f;  // below, the fibres stand too straight for floats
RAYLAB_CONST float kMostSheenAlbedo = 2.5f;  // of the table: the model's own exceeds 1 where the fibres are straight

// Lobes that few materials have; a kernel loads of it what it needs.
struct LobeData {
    vec3 specularColor;
    float clearcoat;
    vec3 sheenColor;
    float sheenRoughness;
    vec3 absorption;  // coefficient, 1 / scene unit
    float clearcoatAlpha;
    float anisotropy;
    float tangentCos;  // of the rotation from the tangent
    float tangentSin;
    uint priority;
};
RAYLAB_CHECK(LobeData, 64);
RAYLAB_CONST uint kWordsLobe = 4;

// Textures of the lobes; kNoTextureIndex: none.
struct LobeTextureData {
    uint clearcoat;
    uint clearcoatRoughness;
    uint clearcoatNormal;
    float clearcoatNormalScale;
    uint sheenColor;
    uint sheenRoughness;
    uint anisotropy;
    uint specular;
    uint specularColor;
    uint transmission;
    uint padding0;
    uint padding1;
};
RAYLAB_CHECK(LobeTextureData, 48);
RAYLAB_CONST uint kWordsLobeTextures = 3;

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

// A node of the tree over lights (engine/accel/light_tree.h): a pair of nodes side by side are the children of one.
struct LightNodeData {
    uint loXY;  // box, 16 bits each, in steps of FrameParams.lightGridStep
    uint loZhiX;
    uint hiYZ;
    uint axis;  // of the cone, octahedral
    float power;
    uint cosines;    // of thetaO and thetaE, 2 x 16 bits signed normalised
    uint reference;  // leaf: a light, emissive triangles before punctual ones; else: the pair of its children
    uint flags;      // kLightNode...
};
RAYLAB_CHECK(LightNodeData, 32);
RAYLAB_CONST uint kWordsLightNode = 2;
RAYLAB_CONST uint kLightNodeLeaf = 1u;
RAYLAB_CONST uint kLightNodeTwoSided = 2u;

RAYLAB_CONST uint kPunctualPoint = 0;
RAYLAB_CONST uint kPunctualDirectional = 1;
RAYLAB_CONST uint kPunctualSpot = 2;
RAYLAB_CONST uint kPunctualSphere = 3;
RAYLAB_CONST uint kPunctualDisc = 4;
RAYLAB_CONST uint kPunctualRectangle = 5;
RAYLAB_CONST uint kPunctualSunDisc = 6;  // a directional light that comes from a disc
RAYLAB_CONST uint kPunctualLambert = 7;  // a point that sends by the cosine from its direction

// `shape`: spot, KHR_lights_punctual: clamp(cos * shape.x + shape.y)^2; sphere, disc: x the radius; rectangle: its second
// edge, and `direction` is its first; sun's disc: x = 1 - cosine of its angular radius. Shapes: `intensity` is their radiance.
struct PunctualData {
    vec3 position;
    uint kind;
    vec3 direction;  // unit, the way the light travels
    float threshold;
    vec3 intensity;
    uint alias;
    vec3 shape;
    float probability;
};
RAYLAB_CHECK(PunctualData, 64);
RAYLAB_CONST uint kWordsPunctual = 4;

RAYLAB_SHARED_END
#endif
