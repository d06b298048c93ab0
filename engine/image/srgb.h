#pragma once

#include <cmath>
#include <cstdint>

namespace raylab {

/// Transfer functions of sRGB: IEC 61966-2-1:1999, section 5.2. Values below 0 stay on the linear piece.

/// Display-encoded [0,1] to linear [0,1].
inline float srgbToLinear(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

/// Linear [0,1] to display-encoded [0,1].
inline float linearToSrgb(float linear) {
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// [0,1] to 0..255, rounded to nearest; clamps, and NaN becomes 0.
inline uint8_t quantize8(float value) {
    if (!(value > 0.0f)) return 0;
    return value >= 1.0f ? uint8_t{255} : static_cast<uint8_t>(std::lround(value * 255.0f));
}

/// The byte that a linear value is stored as in an 8-bit sRGB image; clamps, and NaN becomes 0.
inline uint8_t linearToSrgb8(float linear) { return linear > 0.0f ? quantize8(linearToSrgb(linear)) : uint8_t{0}; }

}  // namespace raylab
