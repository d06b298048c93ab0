#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/bvh8q.glsl"
#include "film/compute.glsl"
#include "wavefront/trace_main.glsl"
