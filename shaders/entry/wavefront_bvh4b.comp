#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_vote : require
#include "trace/bvh4b.glsl"
#include "film/compute.glsl"
#include "wavefront/trace_main.glsl"
