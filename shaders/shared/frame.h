// What changes from frame to frame, the film, and the ray lists of tests and benchmarks.
#ifndef RAYLAB_SHARED_FRAME_H
#define RAYLAB_SHARED_FRAME_H

#include "types.h"

RAYLAB_SHARED_BEGIN

// Integrators, in the order of the table in engine/render/integrators.cpp.
RAYLAB_CONST uint kIntegratorPath = 0;
RAYLAB_CONST uint kIntegratorNormal = 1;
RAYLAB_CONST uint kIntegratorAlbedo = 2;
RAYLAB_CONST uint kIntegratorDepth = 3;
RAYLAB_CONST uint kIntegratorUv = 4;
RAYLAB_CONST uint kIntegratorPrimitive = 5;
RAYLAB_CONST uint kIntegratorInstance = 6;
RAYLAB_CONST uint kIntegratorBarycentrics = 7;

struct FrameParams {
    vec3 cameraPosition;
    float pixelSpread;  // angle between neighbouring pixels, radians
    vec3 cameraRight;   // scaled: half the width of the image at distance 1
    uint width;
    vec3 cameraUp;  // scaled: half the height at distance 1
    uint height;
    vec3 cameraForward;
    uint seed;
    uint tilesPerRow;
    uint maxDepth;
    uint rouletteDepth;
    uint traceInstanceCount;
    uint emissiveCount;
    uint punctualCount;
    uint environmentWidth;  // texels of the map; 0: constant
    uint environmentHeight;
    float shareEmissive;  // probability of each kind of light; they add up to 1
    float sharePunctual;
    float shareEnvironment;
    float emissiveTotal;
    vec3 environmentConstant;  // radiance where there is no map
    float sceneDiagonal;
    vec3 gridOrigin;  // of the root tree
    uint root;        // child reference
    vec3 gridStep;
    uint hasUpperTree;  // 1: the root tree is over instances
};
RAYLAB_CHECK(FrameParams, 160);

// A film pixel in two-float sums: sum and sum of squares as unevaluated hi + lo, so that a million samples lose nothing.
struct FilmPixel {
    vec3 sumHi;
    uint count;
    vec3 sumLo;
    uint nonFinite;  // samples that were not finite and are left out
    vec3 squareHi;
    uint rays;  // traced for this pixel
    vec3 squareLo;
    uint padding;
};
RAYLAB_CHECK(FilmPixel, 64);

struct RenderPush {
    uint firstTile;   // of the image, row by row
    uint firstRow;    // of pixels, of the film band that is bound
    uint firstSample;
    uint sampleCount;
    uint firstLane;  // of each workgroup: a part of a tile where a whole one takes too long
    uint laneCount;
};
RAYLAB_CHECK(RenderPush, 24);

struct RayData {
    vec3 origin;
    float tMin;
    vec3 direction;
    float tMax;
};
RAYLAB_CHECK(RayData, 32);
RAYLAB_CONST uint kWordsRay = 2;

struct HitData {
    float t;  // negative: no hit
    float u;
    float v;
    uint instance;
    uint primitive;
};
RAYLAB_CHECK(HitData, 20);

// What the traversal did for a ray; written where the kernel counts (kSpecCount).
struct RayCounts {
    uint steps;  // of the walk's loop: a node, a leaf or, in layouts of blocks, a primitive
    uint nodes;  // fetched
    uint boxesTested;
    uint boxesHit;
    uint primitivesTested;  // triangles and quadrics; of the hardware tracers: candidates that the kernel is asked about
    uint primitivesHit;     // closer than what was known then
    uint instances;         // entered
    uint stackHigh;         // most entries of the stack in use
};
RAYLAB_CHECK(RayCounts, 32);

struct RaysPush {
    uint count;
    uint anyHit;  // 1: traceOccluded, t = 1 where occluded
};
RAYLAB_CHECK(RaysPush, 8);

RAYLAB_SHARED_END
#endif
