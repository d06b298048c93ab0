// What the traversals of all layouts share: the ray in world space and below an instance, slab tests in integers, the
// leaves.
#ifndef RAYLAB_TRACE_TWO_LEVEL_GLSL
#define RAYLAB_TRACE_TWO_LEVEL_GLSL

#include "trace/candidate.glsl"

// References: engine/accel/layout.h.
const uint kTreeLeafBit = 0x80000000u;
const uint kTreeLeafCountShift = 27;
const uint kTreeLeafFirstMask = 0x07ffffffu;
const uint kTreeEnd = 0xffffffffu;

// Distances are compared as bits, which order like integers from zero on. Of two negative ones it does not matter which
// is taken: that end of the interval is behind the ray. 33 units in the last place are the rounding of both ends, as
// derived in engine/accel/walk_slab.h. The plain test does without them, and without a guard against 0 times infinity.
layout(constant_id = kSpecSlab) const uint kSlab = 0;
const int kTreeSlabUlps = kSlab == kSlabPlain ? 0 : 33;
const float kTreeSmallestDirection = 1.0e-20;

struct SlabRay {
    vec3 origin;
    vec3 reciprocal;  // of the direction
};

SlabRay slabRay(vec3 origin, vec3 direction) {
    if (kSlab == kSlabPlain) return SlabRay(origin, 1.0 / direction);
    vec3 tiny = mix(vec3(kTreeSmallestDirection), vec3(-kTreeSmallestDirection), lessThan(direction, vec3(0.0)));
    return SlabRay(origin, 1.0 / mix(direction, tiny, lessThan(abs(direction), vec3(kTreeSmallestDirection))));
}

SlabRay selectSlabRay(bool second, SlabRay a, SlabRay b) {
    return SlabRay(second ? b.origin : a.origin, second ? b.reciprocal : a.reciprocal);
}

// Where a ray enters (x) and leaves (y) a box, given the distances to its planes.
ivec2 slabInterval(vec3 t0, vec3 t1, int tMin, int tMax) {
    ivec3 near = min(floatBitsToInt(t0), floatBitsToInt(t1));
    ivec3 far = max(floatBitsToInt(t0), floatBitsToInt(t1));
    return ivec2(max(max(near.x, near.y), max(near.z, tMin)), min(min(far.x, far.y), min(far.z, tMax)));
}

// A ray in the local frame of a compressed wide node: t = q * scale + offset. `word`: origin and biased exponents.
struct FrameRay {
    vec3 scale;
    vec3 offset;
};

FrameRay frameRay(SlabRay ray, uvec4 word) {
    vec3 step = uintBitsToFloat(((uvec3(word.w) >> uvec3(0u, 8u, 16u)) & 0xffu) << 23);
    return FrameRay(step * ray.reciprocal, (uintBitsToFloat(word.xyz) - ray.origin) * ray.reciprocal);
}

uvec4 unpackBytes(uint word) { return (uvec4(word) >> uvec4(0u, 8u, 16u, 24u)) & 0xffu; }

ivec4 framePlanes(uint bytes, float scale, float offset) {
    return floatBitsToInt(vec4(unpackBytes(bytes)) * scale + offset);
}

// Four boxes of a frame at once: which are hit, and where they are entered. `lo` and `hi`: a byte a box, of x, y and z.
bvec4 frameSlabs(FrameRay ray, uvec3 lo, uvec3 hi, int tMin, int tMax, out ivec4 near) {
    ivec4 x0 = framePlanes(lo.x, ray.scale.x, ray.offset.x);
    ivec4 x1 = framePlanes(hi.x, ray.scale.x, ray.offset.x);
    ivec4 y0 = framePlanes(lo.y, ray.scale.y, ray.offset.y);
    ivec4 y1 = framePlanes(hi.y, ray.scale.y, ray.offset.y);
    ivec4 z0 = framePlanes(lo.z, ray.scale.z, ray.offset.z);
    ivec4 z1 = framePlanes(hi.z, ray.scale.z, ray.offset.z);
    near = max(max(min(x0, x1), min(y0, y1)), max(min(z0, z1), ivec4(tMin)));
    ivec4 far = min(min(max(x0, x1), max(y0, y1)), min(max(z0, z1), ivec4(tMax)));
    return lessThanEqual(near - kTreeSlabUlps, far);
}

// `top`: of the stack before the node's children go there.
void countNode(uint boxesTested, uint boxesHit, int top) {
    if (kCount == 0u) return;
    ++counted.steps;
    ++counted.nodes;
    counted.boxesTested += boxesTested;
    counted.boxesHit += boxesHit;
    counted.stackHigh = max(counted.stackHigh, uint(top) + 1u);
}

// A step of the walk at a leaf, or at a primitive.
void countLeafStep(int top) {
    if (kCount == 0u) return;
    ++counted.steps;
    counted.stackHigh = max(counted.stackHigh, uint(top) + 1u);
}

// An instance is entered.
void countInstance() {
    if (kCount != 0u) ++counted.instances;
}

// The ray in the space of a tree over triangles.
struct ObjectRay {
    SlabRay slab;
    TriangleRay triangle;
    uint instance;
};

// The ray in the space of the tree at `slot` of the trace instances.
void transformRay(Ray ray, uint slot, out vec3 origin, out vec3 direction) {
    int at = int(slot * kWordsTraceInstance);
    vec4 row0 = uintBitsToFloat(texelFetch(traceInstanceWords, at));
    vec4 row1 = uintBitsToFloat(texelFetch(traceInstanceWords, at + 1));
    vec4 row2 = uintBitsToFloat(texelFetch(traceInstanceWords, at + 2));
    vec4 o = vec4(ray.origin, 1.0);
    origin = vec3(dot(row0, o), dot(row1, o), dot(row2, o));
    direction = vec3(dot(row0.xyz, ray.direction), dot(row1.xyz, ray.direction), dot(row2.xyz, ray.direction));
    if (!needs(kNeedMotion)) return;
    uint instance = texelFetch(traceInstanceWords, at + 4).w;
    if (instance == kInheritInstance) return;  // the merged tree
    InstanceData data = loadInstance(instance);
    if ((data.flags & kInstanceMoves) == 0u) return;
    origin = pointToObject(data, ray.origin);
    direction = vectorToObject(data, ray.direction);
}

// The ray below leaf `slot` of the upper tree. `root`: of the tree there.
ObjectRay enterObject(Ray ray, uint slot, out uint root) {
    vec3 origin, direction;
    transformRay(ray, slot, origin, direction);
    int at = int(slot * kWordsTraceInstance);
    root = texelFetch(traceInstanceWords, at + 3).w;
    uint instance = texelFetch(traceInstanceWords, at + 4).w;
    return ObjectRay(slabRay(origin, direction), triangleRay(origin, direction), instance);
}

// Tests the triangles slot .. last. Alpha is tested once a call, for the first triangle that asks for it: `slot` is then
// the one after it, and the rest is for the next call. Otherwise `slot` ends behind `last`.
void testSlots(Ray ray, ObjectRay object, inout uint slot, uint last, inout Candidate hit) {
    Candidate found = hit;
    for (; slot <= last && !found.untested; ++slot) {
        testTriangle(ray, object.triangle, slot, object.instance, found);
        if (!found.untested) hit = found;
    }
    if (needs(kNeedAlpha) && found.untested && acceptsUntested(found, ray.key)) {
        found.untested = false;
        hit = found;
    }
}

// The same for the triangles first + i of the bits i in `slots`, which lose their bits.
void testSlotBits(Ray ray, ObjectRay object, uint first, inout uint slots, inout Candidate hit) {
    Candidate found = hit;
    while (slots != 0u && !found.untested) {
        testTriangle(ray, object.triangle, first + uint(findLSB(slots)), object.instance, found);
        slots &= slots - 1u;
        if (!found.untested) hit = found;
    }
    if (needs(kNeedAlpha) && found.untested && acceptsUntested(found, ray.key)) {
        found.untested = false;
        hit = found;
    }
}

#endif
