// Lambert: f = albedo / pi.
#ifndef RAYLAB_LAMBERT_GLSL
#define RAYLAB_LAMBERT_GLSL

#include "lib/sampling.glsl"

vec3 evalLambert(vec3 albedo) { return albedo * kInvPi; }

#endif
