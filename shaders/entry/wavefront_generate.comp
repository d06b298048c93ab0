#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "shared/bindings.h"
#include "film/compute.glsl"
#include "wavefront/generate_main.glsl"
