// Adds samples to a film pixel: sum and sum of squares in two-float arithmetic, 48 bits (Dekker 1971; Knuth's TwoSum).
// `precise` forbids the compiler to simplify the error terms away.
#ifndef RAYLAB_ACCUMULATE_GLSL
#define RAYLAB_ACCUMULATE_GLSL

#include "shared/frame.h"

void addTwoFloat(inout vec3 hi, inout vec3 lo, vec3 value) {
    precise vec3 sum = hi + value;
    precise vec3 part = sum - hi;
    precise vec3 error = (hi - (sum - part)) + (value - part);
    precise vec3 low = lo + error;
    precise vec3 high = sum + low;
    lo = low - (high - sum);
    hi = high;
}

void addSample(inout FilmPixel pixel, vec3 value) {
    if (any(isnan(value)) || any(isinf(value))) {
        pixel.nonFinite += 1u;
        return;
    }
    pixel.count += 1u;
    addTwoFloat(pixel.sumHi, pixel.sumLo, value);
    precise vec3 square = value * value;
    precise vec3 residue = fma(value, value, -square);
    addTwoFloat(pixel.squareHi, pixel.squareLo, square);
    addTwoFloat(pixel.squareHi, pixel.squareLo, residue);
}

#endif
