// What the tracers over the driver's structures share: which primitive of ours one of theirs is, and whether a candidate
// is a hit. engine/render/tracer_hardware.h says how the structures are laid out.
#ifndef RAYLAB_TRACE_HARDWARE_GLSL
#define RAYLAB_TRACE_HARDWARE_GLSL

#include "trace/candidate.glsl"

layout(set = 0, binding = kBindTopLevel) uniform accelerationStructureEXT topLevel;

const int kWordsSlot = 3;  // TraceTriangle

struct SlotIds {
    uint instance;
    uint primitive;
    uint opacity;
    uint quadric;  // of a slot that holds one
};

// `custom`: the instance's custom index. `primitive`: within the structure.
SlotIds loadSlot(uint custom, uint primitive) {
    int record = int(custom >> kStructureKindBits) * int(kWordsTraceInstance);
    uint kind = custom & ((1u << kStructureKindBits) - 1u);
    uvec4 range = texelFetch(traceInstanceWords, record + 5);
    uint owner = texelFetch(traceInstanceWords, record + 4).w;
    uint before = kind == kStructureOpaque ? 0u : (kind == kStructureAlpha ? range.z : range.w);
    int at = int(range.x + before + primitive) * kWordsSlot;
    uvec4 w0 = texelFetch(traceTriangleWords, at);
    uint id = texelFetch(traceTriangleWords, at + 1).w;
    uint opacity = needs(kNeedAlpha) ? texelFetch(traceTriangleWords, at + 2).w : kAllOpaque;
    return SlotIds(owner != kInheritInstance ? owner : w0.w & kInstanceMask, id, opacity, w0.x);
}

bool acceptsTriangle(SlotIds ids, vec2 barycentrics, uint key) {
    uint opacity = opacityAt(ids.opacity, barycentrics);
    if (opacity != kOpacityUnknown) return opacity == kOpacityOpaque;
    return acceptsCandidate(ids.instance, ids.primitive, barycentrics, key);
}

bool acceptsQuadric(SlotIds ids, vec2 uv, uint key) {
    if (!needs(kNeedAlpha) || ids.opacity == kAllOpaque) return true;
    return acceptsCandidate(ids.instance, ids.primitive, uv, key);
}

#endif
