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
RAYLAB_CONST uint kIntegratorDirect = 8;
RAYLAB_CONST uint kIntegratorAo = 9;
RAYLAB_CONST uint kIntegratorWhitted = 10;

// What a kernel of `direct` is specialised to, in the order of the settings' choices.
RAYLAB_CONST uint kFresnelSchlick = 0;
RAYLAB_CONST uint kFresnelExact = 1;
RAYLAB_CONST uint kGeometrySchlickDirect = 0;
RAYLAB_CONST uint kGeometrySchlickIbl = 1;
RAYLAB_CONST uint kGeometrySmithCorrelated = 2;
RAYLAB_CONST uint kGeometrySmithSeparable = 3;
RAYLAB_CONST uint kAlphaSquared = 0;
RAYLAB_CONST uint kAlphaLinear = 1;
RAYLAB_CONST uint kShadowsNone = 0;
RAYLAB_CONST uint kShadowsHard = 1;
RAYLAB_CONST uint kShadowsGlass = 2;  // hard, dimmed and tinted by what light passes through

// What a kernel of `whitted` is specialised to, in the order of the settings' choices.
RAYLAB_CONST uint kAttenuationNone = 0;
RAYLAB_CONST uint kAttenuationLinear = 1;
RAYLAB_CONST uint kAttenuationQuadratic = 2;
RAYLAB_CONST uint kHighlightPhong = 0;
RAYLAB_CONST uint kHighlightBlinnPhong = 1;
RAYLAB_CONST uint kReflectionFresnel = 0;
RAYLAB_CONST uint kReflectionFixed = 1;
RAYLAB_CONST uint kBeyondBlack = 0;
RAYLAB_CONST uint kBeyondAverage = 1;

// What of the light that scatters between microfacets more than once is shown, in the order of the setting's choices.
RAYLAB_CONST uint kEnergySingle = 0;    // nothing
RAYLAB_CONST uint kEnergyMultiple = 1;  // all

// Where in its pixel a sample lies.
RAYLAB_CONST uint kAntialiasFilter = 0;  // by the filter
RAYLAB_CONST uint kAntialiasCentre = 1;
RAYLAB_CONST uint kAntialiasGrid = 2;  // four places in turn

// Samplers and filters, in the order of the settings' choices.
RAYLAB_CONST uint kSamplerSobol = 0;
RAYLAB_CONST uint kSamplerIndependent = 1;
RAYLAB_CONST uint kSamplerStratified = 2;
RAYLAB_CONST uint kSamplerBlueNoise = 3;
RAYLAB_CONST uint kFilterBox = 0;
RAYLAB_CONST uint kFilterTent = 1;
RAYLAB_CONST uint kFilterBlackmanHarris = 2;
RAYLAB_CONST uint kFilterGaussian = 3;

// The mask of blue noise: a square of ranks 0 .. 2^bits - 1.
RAYLAB_CONST uint kBlueNoiseSize = 64;
RAYLAB_CONST uint kBlueNoiseRankBits = 12;

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
    uint sampleCount;    // of a pixel in all, and columns of its grid: the stratified sampler
    uint strataWidth;
    float filterRadius;  // pixels
    float lensRadius;    // scene units
    float focusDistance;  // along the axis
    float clampRadiance;  // largest component of a sample
    float mirrorAlpha;  // direct: surfaces of a smaller GGX alpha are mirrors
    float aoDistance;   // length of the rays of ambient occlusion
    uint aoRays;        // of a sample
    float aoShare;      // 1 / aoRays
    uint shapedCount;   // lights of a shape: the first of the punctual ones
    float shutter;      // part of the camera's motion that is seen
    vec3 lightGridOrigin;  // of the boxes in the tree over lights
    uint sunDiscCount;  // the last of the punctual lights
    vec3 lightGridStep;
    float inverseThroughputEnd;  // path: 1 / the throughput under which Russian roulette may end it at any bounce
    vec3 endPosition;  // of the camera where its motion ends, as above
    float padding1;
    vec3 endRight;
    float padding2;
    vec3 endUp;
    float padding3;
    vec3 endForward;
    float padding4;
    vec3 ambient;       // direct, whitted: radiance from everywhere that diffuse surfaces scatter
    float threshold;    // direct, whitted: mean weight under which a branch ends
};
RAYLAB_CHECK(FrameParams, 320);

// A film pixel in two-float sums: sum and sum of squares as unevaluated hi + lo, so that a million samples lose nothing.
struct FilmPixel {
    vec3 sumHi;
    uint count;
    vec3 sumLo;
    uint nonFinite;  // samples that were not finite and are left out
    vec3 squareHi;
    uint rays;  // traced for this pixel
    vec3 squareLo;
    float clamped;  // sum of the luminance that clamping took from its samples
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
