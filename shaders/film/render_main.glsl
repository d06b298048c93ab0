// Renders the samples of a pixel from beginning to end.
#include "film/accumulate.glsl"
#include "film/pixel_work.glsl"
#include "integrators/integrate.glsl"

layout(set = 0, binding = kBindFilm, std430) buffer FilmBlock { FilmPixel film[]; };
layout(push_constant) uniform PushBlock { RenderPush push; };

void main() {
    PixelWork work;
    if (!findPixelWork(push, groupIndex(), laneIndex(), work)) return;
    FilmPixel accumulated = film[work.at];
    for (uint i = work.first; i < work.end; ++i) addSample(accumulated, integrate(work.pixel, i));
    accumulated.rays += tracedRays;
    film[work.at] = accumulated;
}
