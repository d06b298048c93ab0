#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/brute.glsl"
#include "film/compute.glsl"
#include "film/rays_main.glsl"
