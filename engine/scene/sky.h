#pragma once

#include "engine/scene/scene.h"

namespace raylab {

/// Unit direction towards an elevation and an azimuth (azimuth 0 is -Z, growing towards +X).
glm::vec3 skyDirection(float elevationRadians, float azimuthRadians);

/// Daylight as a latitude-longitude map with the sun's disc (0.533 degrees) in it: Preetham, Shirley, Smits, "A
/// Practical Analytic Model for Daylight", SIGGRAPH 1999: sky luminance and chromaticity of section 3.1 and appendix
/// A.2; the sun through Rayleigh and aerosol extinction of appendix A.1. The ground below the horizon is a grey
/// Lambertian plane. One unit of radiance is 14 kcd/m^2 (times sky.scale): a white wall in the sun comes out between 1 and 2.
/// The map's `parts` say the same as a directional light and a mean. `width` must be even; the height is half of it.
Environment makeSky(const SkyDescription& sky, int width = 1024);

}  // namespace raylab
