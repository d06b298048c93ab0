// What the denoiser's kernel is told: the struct and the constants of film/denoise_main.glsl.
#ifndef RAYLAB_SHARED_DENOISE_H
#define RAYLAB_SHARED_DENOISE_H

#include "types.h"

RAYLAB_SHARED_BEGIN

RAYLAB_CONST uint kDenoiseLevels = 5;  // of the wavelet: taps 1, 2, 4, 8 and 16 pixels apart
RAYLAB_CONST uint kDenoiseReach = 2;   // taps to each side
// Where variances come from the picture, the window reaches so far to each side.
RAYLAB_CONST uint kDenoiseWindow = 3;
// In the place of a variance: one to be taken from the pixels around, and a pixel without light to go by.
RAYLAB_CONST float kDenoiseUnknown = -1.0;
RAYLAB_CONST float kDenoiseEmpty = -2.0;

// What a dispatch does with its pixels.
RAYLAB_CONST uint kDenoiseEstimate = 0;  // variance of the light from that of the pixels around
RAYLAB_CONST uint kDenoiseFilter = 1;    // one level of the wavelet

struct DenoisePush {
    uint width;  // of the strip of the picture that is filtered
    uint height;
    uint firstPixel;  // of the dispatch
    uint pixelCount;
    uint task;     // kDenoiseEstimate or kDenoiseFilter
    uint spacing;  // of the taps, in pixels
};
RAYLAB_CHECK(DenoisePush, 24);

RAYLAB_SHARED_END
#endif
