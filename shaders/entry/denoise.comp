#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/bindings.h"
#include "shared/denoise.h"
#include "film/compute.glsl"
#include "film/denoise_main.glsl"
