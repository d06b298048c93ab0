#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require
#include "trace/pipeline_hit.glsl"

void main() {
    SlotIds ids = hitSlot();
    payHit(ids, quadricUvOfHit(ids));
}
