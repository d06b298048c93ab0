// Conversions that lavapipe would do one lane after the other, some seventy instructions each.
#ifndef RAYLAB_CONVERT_GLSL
#define RAYLAB_CONVERT_GLSL

// A whole number of magnitude below 2^22 as an integer, from the bits of 1.5 * 2^23 + x.
int wholeToInt(float x) { return floatBitsToInt(x + 12582912.0) - 0x4b400000; }
ivec2 wholeToInt(vec2 x) { return floatBitsToInt(x + 12582912.0) - 0x4b400000; }

// Quotient and remainder of a number by a width, the quotient below 2^16. The float quotient is off by one at most.
ivec2 divideByWidth(int x, int width) {
    int quotient = wholeToInt(floor(float(x) / float(width)));
    int remainder = x - quotient * width;
    int correction = remainder < 0 ? -1 : (remainder >= width ? 1 : 0);
    return ivec2(quotient + correction, remainder - correction * width);
}

#endif
