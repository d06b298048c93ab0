// Path tracing by queues (shaders/wavefront): where the state of a path and the queues lie, and what a dispatch is told.
#ifndef RAYLAB_SHARED_WAVEFRONT_H
#define RAYLAB_SHARED_WAVEFRONT_H

#include "frame.h"
#include "needs.h"

RAYLAB_SHARED_BEGIN

// What a kernel does, where one file holds several.
RAYLAB_CONST uint kStageClosest = 0;  // the rays of the paths
RAYLAB_CONST uint kStageShadow = 1;   // the rays of the light samples
RAYLAB_CONST uint kStageFinish = 2;   // paths that outlast the rounds, each to its end
RAYLAB_CONST uint kStageScan = 3;     // from counts of keys to places
RAYLAB_CONST uint kStageScatter = 4;  // of the paths to these places

// Order of the queues, in the order of the setting's choices.
RAYLAB_CONST uint kOrderArrival = 0;
RAYLAB_CONST uint kOrderMaterial = 1;  // before shading
RAYLAB_CONST uint kOrderOctant = 2;    // of the rays' directions, before tracing
RAYLAB_CONST uint kOrderOrigin = 3;    // cells of the rays' origins along a Morton curve, then octants, before tracing
RAYLAB_CONST uint kMostKeys = 4096;    // of an order
RAYLAB_CONST uint kMaterialKeys = 1024;
RAYLAB_CONST uint kOctantKeys = 64;    // of which 8 are in use: one a lane of the scan at least
RAYLAB_CONST uint kCellsPerAxis = 8;

// A path's state: arrays of 16-byte words, a word a path in each. What has room in a word of another kind goes there.
RAYLAB_CONST uint kPathOrigin = 0;      // xyz of its ray; rays traced so far
RAYLAB_CONST uint kPathDirection = 1;   // xyz of its ray; primitive of the hit
RAYLAB_CONST uint kPathHit = 2;         // t, barycentrics, instance (kInheritInstance: none)
RAYLAB_CONST uint kPathThroughput = 3;  // rgb; density of the direction
RAYLAB_CONST uint kPathRadiance = 4;    // rgb; scale at boundaries
RAYLAB_CONST uint kPathSample = 5;      // pixel (y << 16 | x), sample, width and spread of the cone
RAYLAB_CONST uint kShadowOrigin = 6;    // by place in the queue of shadow rays: xyz; end of the ray
RAYLAB_CONST uint kShadowDirection = 7; // xyz; path
RAYLAB_CONST uint kShadowLight = 8;     // rgb; key
RAYLAB_CONST uint kPathReceiver = 9;    // two words, with a tree over lights alone: position, normal

// Of the media: the word of the one around the ray (absorption, bounce); then three of those that the path may be inside of.
RAYLAB_FN uint mediumWord(uint lightTree) { return kPathReceiver + (lightTree != 0u ? 2u : 0u); }
RAYLAB_FN uint mediaWord(uint mask, uint lightTree) {
    return mediumWord(lightTree) + ((mask & (kNeedAbsorption | kNeedNesting)) != 0u ? 1u : 0u);
}
// Words of a path in a scene of these needs.
RAYLAB_FN uint pathWordCount(uint mask, uint lightTree) {
    return mediaWord(mask, lightTree) + ((mask & kNeedNesting) != 0u ? 3u : 0u);
}

// The queues, in uints: for each queue of a slice the arguments of its indirect dispatch and its length; two sets of counts
// of keys; then arrays of one uint a place.
RAYLAB_CONST uint kMostRounds = 16;  // a round is a bounce of all paths
RAYLAB_CONST uint kArgumentWords = 4;  // groups, 1, 1, length
RAYLAB_CONST uint kFirstShadowQueue = kMostRounds + 1;  // paths: 0 .. kMostRounds; shadow rays of each round after them
RAYLAB_CONST uint kQueueCount = 2 * kMostRounds + 1;
RAYLAB_CONST uint kFirstKeyCount = 256;
RAYLAB_CONST uint kFirstPlace = kFirstKeyCount + 2 * kMostKeys;
RAYLAB_CONST uint kArraySorted = 2;  // 0 and 1: the paths of even and of odd rounds
RAYLAB_CONST uint kArrayKeys = 3;    // by place in the unsorted array

struct WavefrontPush {
    RenderPush slice;
    uint capacity;  // paths, of each array
    uint lanes;     // of the slice: paths of one sample of each pixel
    vec3 cellOrigin;  // of the cells of kOrderOrigin
    uint round;
    vec3 cellScale;  // 1 / size
    uint pathsPerLane;
};
RAYLAB_CHECK(WavefrontPush, 64);

RAYLAB_SHARED_END
#endif
