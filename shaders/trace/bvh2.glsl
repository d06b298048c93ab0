// Software traversal of a binary BVH with 64-byte nodes: both children's boxes as floats and two child references; four
// uvec4 fetches a node (engine/accel/layout_bvh2.h). While-while (Aila, Laine 2009) with a body without branches; slab
// test padded after Ize, "Robust BVH Ray Traversal", JCGT 2(2), 2013. Two levels where the scene has instances.
#ifndef RAYLAB_TRACE_BVH2_GLSL
#define RAYLAB_TRACE_BVH2_GLSL

#include "trace/two_level.glsl"

const uint kWordsNodeBvh2 = 4u;

ivec2 slabBvh2(SlabRay ray, uvec3 lo, uvec3 hi, int tMin, int tMax) {
    return slabInterval((uintBitsToFloat(lo) - ray.origin) * ray.reciprocal,
                        (uintBitsToFloat(hi) - ray.origin) * ray.reciprocal, tMin, tMax);
}

bool findHit(Ray ray, bool anyHit, out Candidate hit) {
    hit = noCandidate(ray.tMax);
    ++tracedRays;
    if (frame.root == kTreeEnd) return false;
    SlabRay world = slabRay(ray.origin, ray.direction);
    ObjectRay object = ObjectRay(world, triangleRay(ray.origin, ray.direction), kInheritInstance);
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
            int at = int(node * kWordsNodeBvh2);
            uvec4 w0 = texelFetch(nodeWords, at);
            uvec4 w1 = texelFetch(nodeWords, at + 1);
            uvec4 w2 = texelFetch(nodeWords, at + 2);
            uvec4 w3 = texelFetch(nodeWords, at + 3);
            SlabRay slab = object.slab;
            if (needs(kNeedInstancing)) slab = selectSlabRay(upper, object.slab, world);
            ivec2 t0 = slabBvh2(slab, w0.xyz, w1.xyz, tMin, tMax);
            ivec2 t1 = slabBvh2(slab, w2.xyz, w3.xyz, tMin, tMax);
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
