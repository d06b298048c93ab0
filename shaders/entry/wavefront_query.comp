#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#include "trace/query.glsl"
#include "film/compute.glsl"
#include "wavefront/trace_main.glsl"
