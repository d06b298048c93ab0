#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/software.glsl"
#include "film/rays_main.glsl"
