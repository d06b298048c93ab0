// Renders the samples of a pixel from beginning to end.
#include "film/accumulate.glsl"
#include "film/pixel_work.glsl"
#include "integrators/integrate.glsl"

layout(set = 0, binding = kBindFilm, std430) buffer FilmBlock { FilmPixel film[]; };
layout(push_constant) uniform PushBlock { RenderPush push; };

// One loop over the bounces of all samples: a lane whose path has ended goes on with its next one, and does not wait for the
// longest among its neighbours' ("path regeneration": Novak, Havran, Dachsbacher, Eurographics 2010, short papers).
void renderPaths(PixelWork work, inout FilmPixel accumulated) {
    uint next = work.first;
    bool lives = false;
    CameraSample start;
    PathState path;
    while (true) {
        if (!lives) {
            if (next > work.first) addSample(accumulated, path.radiance);
            if (next >= work.end) break;
            start = startSample(work.pixel, next++);
            path = startPath(start.cone);
        }
        lives = followRay(path, start.ray, start.random);
    }
}

void main() {
    PixelWork work;
    if (!findPixelWork(push, groupIndex(), laneIndex(), work)) return;
    FilmPixel accumulated = film[work.at];
    if (kIntegrator == kIntegratorPath)
        renderPaths(work, accumulated);
    else
        for (uint i = work.first; i < work.end; ++i) addSample(accumulated, integrate(work.pixel, i));
    accumulated.rays += tracedRays;
    film[work.at] = accumulated;
}
