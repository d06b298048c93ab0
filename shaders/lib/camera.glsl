// Pinhole camera (methods.md, "Common").
#ifndef RAYLAB_CAMERA_GLSL
#define RAYLAB_CAMERA_GLSL

#include "lib/scene_buffers.glsl"

vec3 cameraDirection(uvec2 pixel, vec2 jitter) {
    vec2 ndc = (vec2(pixel) + jitter) / vec2(frame.width, frame.height) * 2.0 - 1.0;
    return normalize(frame.cameraForward + ndc.x * frame.cameraRight - ndc.y * frame.cameraUp);
}

#endif
