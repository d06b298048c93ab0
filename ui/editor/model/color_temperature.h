#pragma once

#include <glm/glm.hpp>

namespace raylab::editor {

inline constexpr double kLowestKelvin = 1000.0;
inline constexpr double kHighestKelvin = 40000.0;

/// CIE 1931 2-degree tristimulus values of a wavelength, by the multi-lobe fit of C. Wyman, P.-P. Sloan, P. Shirley,
/// "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013, equation 4.
glm::dvec3 colorMatching(double nanometres);

/// CIE xy of a black body: Planck's law against colorMatching, 360 to 830 nm.
glm::dvec2 blackbodyChromaticity(double kelvin);

/// Colour of a black body in linear sRGB primaries with luminance 1; what lies outside their gamut (red below about
/// 1900 K) is taken to its edge. The temperature is taken into kLowestKelvin to kHighestKelvin.
glm::vec3 blackbodyColor(double kelvin);

}  // namespace raylab::editor
