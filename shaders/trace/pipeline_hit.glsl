// What the closest-hit and any-hit shaders know: the slot that was hit, and where.
#include "trace/pipeline_payload.glsl"

layout(location = 0) rayPayloadInEXT HitPayload payload;
hitAttributeEXT vec2 attributes;  // barycentrics of a triangle

SlotIds hitSlot() { return loadSlot(gl_InstanceCustomIndexEXT, gl_PrimitiveID); }

// Not handed over as an attribute: Mesa 25.0's lavapipe keeps what the last intersection shader wrote there, also of one
// that reported nothing.
vec2 quadricUvOfHit(SlotIds ids) {
    return quadricUvAt(gl_ObjectRayOriginEXT + gl_HitTEXT * gl_ObjectRayDirectionEXT, ids.quadric);
}

void payHit(SlotIds ids, vec2 barycentrics) {
    payload.t = gl_HitTEXT;
    payload.barycentrics = barycentrics;
    payload.instance = ids.instance;
    payload.primitive = ids.primitive;
}
