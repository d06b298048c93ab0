#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bindings.h"
#include "film/compute.glsl"
#include "wavefront/film_main.glsl"
