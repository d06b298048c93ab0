// What the stages of the ray tracing pipeline hand to each other.
#ifndef RAYLAB_PIPELINE_PAYLOAD_GLSL
#define RAYLAB_PIPELINE_PAYLOAD_GLSL

#include "trace/hardware.glsl"

struct HitPayload {
    float t;  // negative: no hit
    vec2 barycentrics;
    uint instance;
    uint primitive;
    uint key;  // Ray.key
};

#endif
