#version 460
#extension GL_GOOGLE_include_directive : require
// Chooses lights by the tree, or says with which probability it would (tests/statistical/light_tree_test.cpp).
#include "lib/light_tree.glsl"
#include "lib/random.glsl"
#include "routines.h"

layout(local_size_x = kWorkgroupSize) in;
layout(constant_id = kSpecRoutine) const uint kRoutine = kRoutineChooseLight;
layout(push_constant) uniform PushBlock { LightChoicePush push; };
layout(set = 0, binding = kBindHits, std430) writeonly buffer ResultBlock { uvec2 result[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    Receiver receiver = Receiver(push.position, push.normal);
    if (kRoutine == kRoutineLightTrail) {
        result[i] = uvec2(i, floatBitsToUint(lightProbability(receiver, texelFetch(lightTrails, int(i)).x)));
        return;
    }
    uint key = hashCombine(push.seed, i);
    float probability;
    uint light = chooseLight(receiver, vec2(unitFloat(key), unitFloat(hashUint(key ^ 0x68bc21ebu))), probability);
    result[i] = uvec2(light, floatBitsToUint(probability));
}
