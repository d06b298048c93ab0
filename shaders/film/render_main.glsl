// A group of lanes renders a tile of 8 x 8 pixels, or some of them does; a dispatch is a range of tiles and of samples.
#include "film/accumulate.glsl"
#include "integrators/integrate.glsl"

layout(set = 0, binding = kBindFilm, std430) buffer FilmBlock { FilmPixel film[]; };
layout(constant_id = kSpecAdaptive) const uint kAdaptive = 0;
layout(set = 0, binding = kBindSampleRates) uniform samplerBuffer sampleRates;
layout(push_constant) uniform PushBlock { RenderPush push; };

// Lanes in blocks of 4 x 2 pixels, so that the eight lanes of a vector see nearly the same part of the scene.
uvec2 pixelInTile(uint lane) {
    uint block = lane / kLanesPerBlock;
    return uvec2((block & 1u) * 4u + (lane & 3u), (block >> 1) * 2u + ((lane >> 2) & 1u));
}

void main() {
    if (laneIndex() - push.firstLane >= push.laneCount) return;
    uint tile = push.firstTile + groupIndex();
    uvec2 corner = uvec2(tile % frame.tilesPerRow, tile / frame.tilesPerRow) * kTileSize;
    uvec2 pixel = corner + pixelInTile(laneIndex());
    if (pixel.x >= frame.width || pixel.y >= frame.height) return;
    uint at = (pixel.y - push.firstRow) * frame.width + pixel.x;
    FilmPixel accumulated = film[at];
    uint first = push.firstSample, end = push.firstSample + push.sampleCount;
    if (kAdaptive != 0u) {
        // What the block has at one moment less what it has at the other: rounded the same way, no sample is lost or done twice.
        float rate = texelFetch(sampleRates, int(tile * (kWorkgroupSize / kLanesPerBlock) + laneIndex() / kLanesPerBlock)).x;
        first = uint(rate * float(first));
        end = uint(rate * float(end));
    }
    for (uint i = first; i < end; ++i) addSample(accumulated, integrate(pixel, i));
    accumulated.rays += tracedRays;
    film[at] = accumulated;
}
