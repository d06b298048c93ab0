// What a kernel contains. A bit that the scene does not need is a branch that the specialised kernel does not have.
#ifndef RAYLAB_SHARED_NEEDS_H
#define RAYLAB_SHARED_NEEDS_H

#include "types.h"

RAYLAB_SHARED_BEGIN

RAYLAB_CONST uint kNeedInstancing = 1u << 0;      // two levels: a tree over instances above the trees over triangles
RAYLAB_CONST uint kNeedTransforms = 1u << 1;      // an instance whose matrix is not the identity
RAYLAB_CONST uint kNeedSmoothNormals = 1u << 2;   // vertex normals
RAYLAB_CONST uint kNeedTextures = 1u << 3;        // any texture fetch, hence texture coordinates and ray cones
RAYLAB_CONST uint kNeedNormalMaps = 1u << 4;      // tangent frames and normal textures
RAYLAB_CONST uint kNeedAlpha = 1u << 5;           // alpha test inside the traversal
RAYLAB_CONST uint kNeedSpecular = 1u << 6;        // GGX reflection (dielectric coat or metal)
RAYLAB_CONST uint kNeedTransmission = 1u << 7;    // smooth dielectric
RAYLAB_CONST uint kNeedEmissive = 1u << 8;        // emissive triangles as lights
RAYLAB_CONST uint kNeedPunctual = 1u << 9;        // point, directional and spot lights
RAYLAB_CONST uint kNeedEnvironment = 1u << 10;    // radiance from infinitely far away
RAYLAB_CONST uint kNeedQuadrics = 1u << 11;       // surfaces of the second degree
RAYLAB_CONST uint kNeedSpecularTint = 1u << 12;   // coloured reflection of dielectrics
RAYLAB_CONST uint kNeedClearcoat = 1u << 13;      // a second layer above the base
RAYLAB_CONST uint kNeedSheen = 1u << 14;          // cloth
RAYLAB_CONST uint kNeedAnisotropy = 1u << 15;     // GGX of two roughnesses, hence tangents
RAYLAB_CONST uint kNeedRoughTransmission = 1u << 16;  // rough dielectric
RAYLAB_CONST uint kNeedAbsorption = 1u << 17;     // light fades inside volumes
RAYLAB_CONST uint kNeedNesting = 1u << 18;        // volumes that overlap, by priority
RAYLAB_CONST uint kNeedShapes = 1u << 19;         // lights of a shape: spheres, discs, rectangles, the sun's disc
RAYLAB_CONST uint kNeedLobeTextures = 1u << 20;  // textures of lobes that few materials have
RAYLAB_CONST uint kNeedCoatNormals = 1u << 21;   // a clear coat whose normal is not the base's
RAYLAB_CONST uint kNeedMotion = 1u << 22;        // instances that move while the shutter is open
RAYLAB_CONST uint kNeedCount = 23;
RAYLAB_CONST uint kNeedAll = (1u << 23) - 1u;

RAYLAB_SHARED_END
#endif
