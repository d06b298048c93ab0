#pragma once

#include <glm/glm.hpp>
#include <span>

namespace raylab::assets {

/// A spectrum sampled every `stepNm` from `firstNm` on, linear in between; constant beyond its ends.
struct Spectrum {
    float firstNm;
    float stepNm;
    std::span<const float> values;
};

float valueAt(const Spectrum& spectrum, float wavelengthNm);

/// Linear sRGB of a radiance spectrum over 400 to 700 nm, divided by the integral of CIE y: a constant spectrum of 1
/// has luminance 1. Colour matching functions: Wyman, Sloan, Shirley, "Simple Analytic Approximations to the CIE XYZ
/// Color Matching Functions", JCGT 2(2), 2013, section 2.2 (multi-lobe fit, within 1 % of the CIE 1931 integrals).
glm::vec3 radianceToRgb(const Spectrum& radiance);

/// Reflectance in linear sRGB as seen under `light`: RGB(reflectance * light) / RGB(light), a channel at a time, so
/// that the light's RGB times the result is exactly the colour of the first bounce. Clamped to [0, 1].
glm::vec3 reflectanceToRgb(const Spectrum& reflectance, const Spectrum& light);

}  // namespace raylab::assets
