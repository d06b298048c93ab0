// Software traversal of a binary BVH with 32-byte nodes: both children's boxes as 16-bit integers on a grid of their
// tree, rounded outwards, and two child references; two uvec4 fetches a node (engine/accel/layout_bvh2q.h).
// While-while (Aila, Laine 2009) with a body without branches; slab test padded after Ize, "Robust BVH Ray Traversal",
// JCGT 2(2), 2013. Two levels where the scene has instances: a leaf of the upper tree transforms the ray.
#ifndef RAYLAB_TRACE_BVH2Q_GLSL
#define RAYLAB_TRACE_BVH2Q_GLSL

#include "trace/candidate.glsl"

const uint kLeafBit = 0x80000000u;
const uint kLeafCountShift = 27;
const uint kLeafFirstMask = 0x07ffffffu;
// References that no tree contains (a leaf of 16 slots at the very end of the range): what the stack's bottom and the
// way out of an instance look like.
const uint kEndOfWalk = 0xffffffffu;
const uint kLeaveInstance = 0xfffffffeu;

// Relative error of (origin - o) * r + q * step * r, five roundings, on both ends of the interval.
const float kSlabPad = 1.000001;
const float kSmallestDirection = 1.0e-20;

// Planes of the tree's grid as distances along the ray: t(q) = q * scale + offset.
struct GridRay {
    vec3 scale;
    vec3 offset;
};

GridRay gridRay(vec3 origin, vec3 direction, vec3 gridOrigin, vec3 gridStep) {
    vec3 tiny = mix(vec3(kSmallestDirection), vec3(-kSmallestDirection), lessThan(direction, vec3(0.0)));
    vec3 r = 1.0 / mix(direction, tiny, lessThan(abs(direction), vec3(kSmallestDirection)));
    return GridRay(gridStep * r, (gridOrigin - origin) * r);
}

// Interval of the ray in a quantised box.
vec2 slab(GridRay ray, uvec3 box, float tMin, float tMax) {
    vec3 t0 = vec3(box & 0xffffu) * ray.scale + ray.offset;
    vec3 t1 = vec3(box >> 16) * ray.scale + ray.offset;
    vec3 near = min(t0, t1);
    vec3 far = max(t0, t1);
    return vec2(max(max(near.x, near.y), max(near.z, tMin)), min(min(far.x, far.y), min(far.z, tMax)) * kSlabPad);
}

// The ray in the space of the tree that is being walked.
struct Walk {
    GridRay grid;
    ShearedRay sheared;
    uint instance;
};

Walk enterTree(vec3 origin, vec3 direction, vec3 gridOrigin, vec3 gridStep, uint instance) {
    return Walk(gridRay(origin, direction, gridOrigin, gridStep), shearRay(origin, direction), instance);
}

Walk enterRoot(Ray ray) {
    return enterTree(ray.origin, ray.direction, frame.gridOrigin, frame.gridStep, kInheritInstance);
}

// Down into the tree of leaf `slot` of the upper tree, or back up where `leave`. One text for both, because lavapipe runs
// both sides of every branch. `root`: of the tree that is entered.
Walk changeTree(Ray ray, bool leave, uint slot, out uint root) {
    int at = int(slot * kWordsTraceInstance);
    vec4 row0 = uintBitsToFloat(texelFetch(traceInstanceWords, at));
    vec4 row1 = uintBitsToFloat(texelFetch(traceInstanceWords, at + 1));
    vec4 row2 = uintBitsToFloat(texelFetch(traceInstanceWords, at + 2));
    uvec4 a = texelFetch(traceInstanceWords, at + 3);
    uvec4 b = texelFetch(traceInstanceWords, at + 4);
    vec4 o = vec4(ray.origin, 1.0);
    vec3 origin = vec3(dot(row0, o), dot(row1, o), dot(row2, o));
    vec3 direction = vec3(dot(row0.xyz, ray.direction), dot(row1.xyz, ray.direction), dot(row2.xyz, ray.direction));
    root = a.w;
    return enterTree(leave ? ray.origin : origin, leave ? ray.direction : direction,
                     leave ? frame.gridOrigin : uintBitsToFloat(a.xyz), leave ? frame.gridStep : uintBitsToFloat(b.xyz),
                     leave ? kInheritInstance : b.w);
}

bool findHit(Ray ray, bool anyHit, Cursor after, out Candidate hit) {
    hit = noCandidate(ray.tMax);
    ++tracedRays;
    if (frame.root == kEndOfWalk) return false;
    Walk state = enterRoot(ray);
    bool upper = needs(kNeedInstancing) && frame.hasUpperTree != 0u;
    uint stack[kStackSize];
    stack[0] = kEndOfWalk;
    uint top = 0u;  // of the stack: the entry that is popped next
    uint node = frame.root;
    while (node != kEndOfWalk) {
        while (node < kLeafBit) {
            uvec4 w0 = texelFetch(nodeWords, int(node * 2u));
            uvec4 w1 = texelFetch(nodeWords, int(node * 2u + 1u));
            vec2 t0 = slab(state.grid, w0.xyz, ray.tMin, hit.t);
            vec2 t1 = slab(state.grid, w1.xyz, ray.tMin, hit.t);
            bool hit0 = t0.x <= t0.y;
            bool hit1 = t1.x <= t1.y;
            bool secondFirst = hit1 && (!hit0 || t1.x < t0.x);
            uint popped = stack[top];
            stack[top + 1u] = secondFirst ? w0.w : w1.w;
            node = secondFirst ? w1.w : (hit0 ? w0.w : popped);
            top += hit0 && hit1 ? 1u : (hit0 || hit1 ? 0u : 0xffffffffu);
        }
        if (node == kEndOfWalk) break;
        bool leave = node == kLeaveInstance;
        if (needs(kNeedInstancing) && (upper || leave)) {
            uint root;
            state = changeTree(ray, leave, leave ? 0u : node & kLeafFirstMask, root);
            uint popped = stack[top];
            stack[top + 1u] = kLeaveInstance;
            node = leave ? popped : root;
            top += leave ? 0xffffffffu : 1u;
            upper = leave;
            continue;
        }
        uint first = node & kLeafFirstMask;
        uint last = first + ((node >> kLeafCountShift) & 15u);
        for (uint slot = first; slot <= last; ++slot) testTriangle(ray, state.sheared, slot, state.instance, after, hit);
        if (anyHit && hit.instance != kInheritInstance) return true;
        node = stack[top--];
    }
    return hit.instance != kInheritInstance;
}

#include "trace/refine.glsl"

#endif
