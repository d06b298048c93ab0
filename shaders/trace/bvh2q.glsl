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
// A reference that no tree contains (a leaf of 16 slots at the very end of the range): the stack's bottom.
const uint kEndOfWalk = 0xffffffffu;

// Relative error of (origin - o) * r + q * step * r on both ends of the interval, Vulkan's division of 2.5 ulp included:
// derived in engine/accel/walk_bvh2q.h, whose walk on the CPU pads by the same.
const float kSlabPad = 1.000002;
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

GridRay select(bool second, GridRay a, GridRay b) {
    return GridRay(second ? b.scale : a.scale, second ? b.offset : a.offset);
}

// The ray in the space of a tree over triangles.
struct LowerRay {
    GridRay grid;
    ShearedRay sheared;
    uint instance;
};

// The ray below leaf `slot` of the upper tree. `root`: of the tree there.
LowerRay enterInstance(Ray ray, uint slot, out uint root) {
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
    return LowerRay(gridRay(origin, direction, uintBitsToFloat(a.xyz), uintBitsToFloat(b.xyz)),
                    shearRay(origin, direction), b.w);
}

bool findHit(Ray ray, bool anyHit, out Candidate hit) {
    hit = noCandidate(ray.tMax);
    ++tracedRays;
    if (frame.root == kEndOfWalk) return false;
    GridRay world = gridRay(ray.origin, ray.direction, frame.gridOrigin, frame.gridStep);
    LowerRay lower = LowerRay(world, shearRay(ray.origin, ray.direction), kInheritInstance);
    bool upper = needs(kNeedInstancing) && frame.hasUpperTree != 0u;
    uint stack[kStackSize];
    stack[0] = kEndOfWalk;
    int top = 0;    // of the stack: the entry that is popped next
    int floor = -1;  // below an instance: the topmost entry of the upper tree; popping it leads back there
    uint node = frame.root;
    while (node != kEndOfWalk) {
        while (node < kLeafBit) {
            uvec4 w0 = texelFetch(nodeWords, int(node * 2u));
            uvec4 w1 = texelFetch(nodeWords, int(node * 2u + 1u));
            GridRay grid = lower.grid;
            if (needs(kNeedInstancing)) grid = select(upper, lower.grid, world);
            vec2 t0 = slab(grid, w0.xyz, ray.tMin, hit.t);
            vec2 t1 = slab(grid, w1.xyz, ray.tMin, hit.t);
            bool hit0 = t0.x <= t0.y;
            bool hit1 = t1.x <= t1.y;
            bool secondFirst = hit1 && (!hit0 || t1.x < t0.x);
            bool pop = !hit0 && !hit1;
            if (needs(kNeedInstancing)) upper = upper || (pop && top <= floor);
            uint popped = stack[top];
            stack[top + 1] = secondFirst ? w0.w : w1.w;
            node = secondFirst ? w1.w : (hit0 ? w0.w : popped);
            top += hit0 && hit1 ? 1 : (pop ? -1 : 0);
        }
        if (node == kEndOfWalk) break;
        uint first = node & kLeafFirstMask;
        if (needs(kNeedInstancing) && upper) {
            lower = enterInstance(ray, first, node);
            floor = top;
            upper = false;
            continue;
        }
        uint last = first + ((node >> kLeafCountShift) & 15u);
        uint slot = first;
        Candidate found = hit;
        for (; slot <= last && !found.untested; ++slot) {
            testTriangle(ray, lower.sheared, slot, lower.instance, found);
            if (!found.untested) hit = found;
        }
        if (needs(kNeedAlpha)) {
            // Alpha is tested once a step, for the first triangle that asks for it; the rest of the leaf is the next step.
            if (found.untested && acceptsUntested(found, ray.key)) {
                found.untested = false;
                hit = found;
            }
            if (slot <= last && !(anyHit && hit.instance != kInheritInstance)) {
                node = kLeafBit | ((last - slot) << kLeafCountShift) | slot;
                continue;
            }
        }
        if (anyHit && hit.instance != kInheritInstance) return true;
        if (needs(kNeedInstancing)) upper = top <= floor;
        node = stack[top--];
    }
    return hit.instance != kInheritInstance;
}

#include "trace/interface.glsl"

#endif
