// Adds the samples of the slice to their pixels, each pixel's in their order: a film does not show how they were made.
#include "film/accumulate.glsl"
#include "film/pixel_work.glsl"
#include "wavefront/queues.glsl"

layout(set = 0, binding = kBindFilm, std430) buffer FilmBlock { FilmPixel film[]; };

void main() {
    PixelWork work;
    if (!findPixelWork(push.slice, groupIndex(), laneIndex(), work)) return;
    FilmPixel accumulated = film[work.at];
    uint path = groupIndex() * kWorkgroupSize + laneIndex() - push.slice.firstLane;
    for (uint i = work.first; i < work.end; ++i) {
        addSample(accumulated, loadFloats(kPathRadiance, path).xyz);
        accumulated.rays += loadWord(kPathOrigin, path).w;
        path += push.lanes;
    }
    film[work.at] = accumulated;
}
