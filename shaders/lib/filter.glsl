// Reconstruction filters of the film as densities of the place in the image where a camera ray starts (Ernst, Stamminger,
// Greiner, "Filter Importance Sampling", IEEE Symposium on Interactive Ray Tracing 2006): every sample then counts the same
// and belongs to one pixel. All are non-negative, symmetric, and zero beyond frame.filterRadius pixels.
#ifndef RAYLAB_FILTER_GLSL
#define RAYLAB_FILTER_GLSL

#include "lib/sampling.glsl"
#include "lib/scene_buffers.glsl"

layout(constant_id = kSpecFilter) const uint kFilter = kFilterBox;

// Four-term Blackman-Harris window (Harris, Proc. IEEE 66(1), 1978, table 1), a0 + a1 cos pi x + a2 cos 2 pi x + a3 cos 3 pi x.
const vec4 kBlackmanHarris = vec4(0.35875, 0.48829, 0.14128, 0.01168);

// The window at x in [-1, 1], over its integral.
vec2 blackmanHarris(vec2 x) {
    vec2 c = cos(kPi * x);
    vec2 c2 = 2.0 * c * c - 1.0;
    vec2 c3 = (2.0 * c2 - 1.0) * c;
    return 0.5 * (kBlackmanHarris.x + kBlackmanHarris.y * c + kBlackmanHarris.z * c2 + kBlackmanHarris.w * c3) / kBlackmanHarris.x;
}

// Its integral from 0 to x, over that from -1 to 1.
vec2 blackmanHarrisIntegral(vec2 x) {
    vec2 s = sin(kPi * x), c = cos(kPi * x);
    vec2 s2 = 2.0 * s * c;
    vec2 s3 = s * (4.0 * c * c - 1.0);
    vec2 waves = kBlackmanHarris.y * s + kBlackmanHarris.z / 2.0 * s2 + kBlackmanHarris.w / 3.0 * s3;
    return 0.5 * (x + waves * kInvPi / kBlackmanHarris.x);
}

// Inverse of the integral: bisection on the half where u lies, then one step of Newton's method within the bracket.
vec2 sampleBlackmanHarris(vec2 u) {
    vec2 target = abs(u - 0.5);
    vec2 low = vec2(0.0), high = vec2(1.0);
    for (int i = 0; i < 10; ++i) {
        vec2 middle = 0.5 * (low + high);
        bvec2 beyond = greaterThan(blackmanHarrisIntegral(middle), target);
        high = mix(high, middle, beyond);
        low = mix(middle, low, beyond);
    }
    vec2 x = 0.5 * (low + high);
    x = clamp(x - (blackmanHarrisIntegral(x) - target) / blackmanHarris(x), low, high);
    return mix(x, -x, lessThan(u, vec2(0.5)));
}

// A Gaussian of a third of the radius, cut at the radius: Box, Muller 1958 on the part of [0, 1) that stays inside.
vec2 sampleGaussian(vec2 u) {
    const float kInside = 0.988891003;  // 1 - exp(-3^2 / 2)
    float r = sqrt(-2.0 * log(1.0 - kInside * u.x)) / 3.0;
    float phi = 2.0 * kPi * u.y;
    return r * vec2(cos(phi), sin(phi));
}

// Where in the image, in pixels from the corner of the pixel whose sample it is. Box of radius 1/2: u itself, to the bit.
vec2 sampleFilter(vec2 u) {
    vec2 offset = 2.0 * u - 1.0;
    if (kFilter == kFilterTent) offset = vec2(sampleTent(u.x), sampleTent(u.y));
    if (kFilter == kFilterBlackmanHarris) offset = sampleBlackmanHarris(u);
    if (kFilter == kFilterGaussian) offset = sampleGaussian(u);
    return 0.5 + frame.filterRadius * offset;
}

#endif
