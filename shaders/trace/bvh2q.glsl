// Software traversal of a binary BVH with 32-byte nodes: both children's boxes as 16-bit integers on a grid of their
// tree, rounded outwards, and two child references; two uvec4 fetches a node (engine/accel/layout_bvh2q.h).
// While-while (Aila, Laine 2009) with a body without branches; slab test padded after Ize, "Robust BVH Ray Traversal",
// JCGT 2(2), 2013. Two levels where the scene has instances: a leaf of the upper tree transforms the ray.
#ifndef RAYLAB_TRACE_BVH2Q_GLSL
#define RAYLAB_TRACE_BVH2Q_GLSL

#include "trace/two_level.glsl"

// Planes of the tree's grid as distances along the ray: t(q) = q * scale + offset.
struct GridRay {
    vec3 scale;
    vec3 offset;
};

GridRay gridRay(SlabRay ray, vec3 gridOrigin, vec3 gridStep) {
    return GridRay(gridStep * ray.reciprocal, (gridOrigin - ray.origin) * ray.reciprocal);
}

ivec2 slabBvh2q(GridRay ray, uvec3 box, int tMin, int tMax) {
    return slabInterval(vec3(box & 0xffffu) * ray.scale + ray.offset, vec3(box >> 16) * ray.scale + ray.offset, tMin, tMax);
}

GridRay selectGridRay(bool second, GridRay a, GridRay b) {
    return GridRay(second ? b.scale : a.scale, second ? b.offset : a.offset);
}

// The grid of the tree below leaf `slot` of the upper tree.
GridRay enterGrid(SlabRay ray, uint slot) {
    int at = int(slot * kWordsTraceInstance);
    vec3 origin = uintBitsToFloat(texelFetch(traceInstanceWords, at + 3).xyz);
    return gridRay(ray, origin, uintBitsToFloat(texelFetch(traceInstanceWords, at + 4).xyz));
}

bool findHit(Ray ray, bool anyHit, out Candidate hit) {
    hit = noCandidate(ray.tMax);
    ++tracedRays;
    if (frame.root == kTreeEnd) return false;
    SlabRay slab = slabRay(ray.origin, ray.direction);
    GridRay world = gridRay(slab, frame.gridOrigin, frame.gridStep);
    GridRay lower = world;
    ObjectRay object = ObjectRay(slab, triangleRay(ray.origin, ray.direction), kInheritInstance);
    bool upper = needs(kNeedInstancing) && frame.hasUpperTree != 0u;
    uint stack[kStackSize];
    stack[0] = kTreeEnd;
    int top = 0;    // of the stack: the entry that is popped next
    int floor = -1;  // below an instance: the topmost entry of the upper tree; popping it leads back there
    uint node = frame.root;
    int tMin = floatBitsToInt(ray.tMin);
    while (node != kTreeEnd) {
        int tMax = floatBitsToInt(hit.t);
        while (node < kTreeLeafBit) {
            uvec4 w0 = texelFetch(nodeWords, int(node * 2u));
            uvec4 w1 = texelFetch(nodeWords, int(node * 2u + 1u));
            GridRay grid = lower;
            if (needs(kNeedInstancing)) grid = selectGridRay(upper, lower, world);
            ivec2 t0 = slabBvh2q(grid, w0.xyz, tMin, tMax);
            ivec2 t1 = slabBvh2q(grid, w1.xyz, tMin, tMax);
            bool hit0 = t0.x - kTreeSlabUlps <= t0.y;
            bool hit1 = t1.x - kTreeSlabUlps <= t1.y;
            countNode(2u, uint(hit0) + uint(hit1), top);
            bool secondFirst = hit1 && (!hit0 || t1.x < t0.x);
            bool pop = !hit0 && !hit1;
            if (needs(kNeedInstancing)) upper = upper || (pop && top <= floor);
            uint popped = stack[top];
            stack[top + 1] = secondFirst ? w0.w : w1.w;
            node = secondFirst ? w1.w : (hit0 ? w0.w : popped);
            top += hit0 && hit1 ? 1 : (pop ? -1 : 0);
        }
        if (node == kTreeEnd) break;
        countLeafStep(top);
        uint slot = node & kTreeLeafFirstMask;
        if (needs(kNeedInstancing) && upper) {
            countInstance();
            object = enterObject(ray, slot, node);
            lower = enterGrid(object.slab, slot);
            floor = top;
            upper = false;
            continue;
        }
        uint last = slot + ((node >> kTreeLeafCountShift) & 15u);
        testSlots(ray, object, slot, last, hit);
        if (anyHit && hit.instance != kInheritInstance) return true;
        if (needs(kNeedAlpha) && slot <= last) {
            node = kTreeLeafBit | ((last - slot) << kTreeLeafCountShift) | slot;
            continue;
        }
        if (needs(kNeedInstancing)) upper = top <= floor;
        node = stack[top--];
    }
    return hit.instance != kInheritInstance;
}

#include "trace/interface.glsl"

#endif
