// Adds samples to a film pixel: sum and sum of squares in two-float arithmetic, 48 bits (Dekker 1971; Knuth's TwoSum).
// `precise` forbids the compiler to simplify the error terms away.
#ifndef RAYLAB_ACCUMULATE_GLSL
#define RAYLAB_ACCUMULATE_GLSL

#include "lib/sampling.glsl"
#include "lib/scene_buffers.glsl"

layout(constant_id = kSpecClamp) const uint kClamp = 0;

void addTwoFloat(inout vec3 hi, inout vec3 lo, vec3 value) {
    precise vec3 sum = hi + value;
    precise vec3 part = sum - hi;
    precise vec3 error = (hi - (sum - part)) + (value - part);
    precise vec3 low = lo + error;
    precise vec3 high = sum + low;
    lo = low - (high - sum);
    hi = high;
}

// value^2 - square, exactly: Dekker's product over Veltkamp's split in halves of 12 bits. fma() would do it in one step, but
// Vulkan lets a driver round it twice, and lavapipe does.
vec3 squareResidue(vec3 value, vec3 square) {
    precise vec3 scaled = value * 4097.0;
    precise vec3 high = scaled - (scaled - value);
    precise vec3 low = value - high;
    precise vec3 residue = ((high * high - square) + 2.0 * (high * low)) + low * low;
    return residue;
}

// Scales a sample down whose largest component is beyond frame.clampRadiance: against fireflies, at the price of a bias that
// the pixel keeps count of.
vec3 clampSample(inout FilmPixel pixel, vec3 value) {
    float largest = maxComponent(value);
    if (largest <= frame.clampRadiance) return value;
    vec3 kept = value * (frame.clampRadiance / largest);
    pixel.clamped += luminance(value - kept);
    return kept;
}

void addSample(inout FilmPixel pixel, vec3 value) {
    if (any(isnan(value)) || any(isinf(value))) {
        pixel.nonFinite += 1u;
        return;
    }
    if (kClamp != 0u) value = clampSample(pixel, value);
    pixel.count += 1u;
    addTwoFloat(pixel.sumHi, pixel.sumLo, value);
    precise vec3 square = value * value;
    addTwoFloat(pixel.squareHi, pixel.squareLo, square);
    addTwoFloat(pixel.squareHi, pixel.squareLo, squareResidue(value, square));
}

#endif
