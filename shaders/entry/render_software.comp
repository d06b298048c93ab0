#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/software.glsl"
#include "film/render_main.glsl"
