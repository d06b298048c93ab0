// Which pixel an invocation works for, and which of its samples: a group of lanes has a tile of 8 x 8 pixels, or some of them
// have; a dispatch is a range of tiles and of samples.
#ifndef RAYLAB_PIXEL_WORK_GLSL
#define RAYLAB_PIXEL_WORK_GLSL

#include "lib/scene_buffers.glsl"

layout(constant_id = kSpecAdaptive) const uint kAdaptive = 0;
layout(set = 0, binding = kBindSampleRates) uniform samplerBuffer sampleRates;

struct PixelWork {
    uvec2 pixel;
    uint at;  // in the film band
    uint first;
    uint end;  // of its samples
};

// Lanes in blocks of 4 x 2 pixels, so that the eight lanes of a vector see nearly the same part of the scene.
uvec2 pixelInTile(uint lane) {
    uint block = lane / kLanesPerBlock;
    return uvec2((block & 1u) * 4u + (lane & 3u), (block >> 1) * 2u + ((lane >> 2) & 1u));
}

// False where there is no pixel: outside the image, or a lane that the slice leaves out.
bool findPixelWork(RenderPush slice, uint group, uint lane, out PixelWork work) {
    uint tile = slice.firstTile + group;
    uvec2 corner = uvec2(tile % frame.tilesPerRow, tile / frame.tilesPerRow) * kTileSize;
    uvec2 pixel = corner + pixelInTile(lane);
    work = PixelWork(pixel, (pixel.y - slice.firstRow) * frame.width + pixel.x, slice.firstSample,
                     slice.firstSample + slice.sampleCount);
    if (kAdaptive != 0u) {
        // What the block has at one moment less what it has at the other: rounded the same way, no sample is lost or done twice.
        float rate = texelFetch(sampleRates, int(tile * (kWorkgroupSize / kLanesPerBlock) + lane / kLanesPerBlock)).x;
        work.first = uint(rate * float(work.first));
        work.end = uint(rate * float(work.end));
    }
    return lane - slice.firstLane < slice.laneCount && pixel.x < frame.width && pixel.y < frame.height;
}

#endif
