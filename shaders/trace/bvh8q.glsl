// Software traversal of the compressed 8-wide BVH of Ylitie, Karras and Laine, "Efficient Incoherent Ray Traversal on
// GPUs Through Compressed Wide BVHs", HPG 2017: 80-byte nodes, boxes of 8 bits in a local frame, children in octant
// order; five uvec4 fetches a node (engine/accel/layout_bvh8q.h, walk_bvh8q.h). A group, two uints, holds all inner
// children that are left of a node, in bits from 24 on, or slots below; the slots that a node's leaves add wait in
// registers and are tested before the walk goes on. Two levels where the scene has instances.
#ifndef RAYLAB_TRACE_BVH8Q_GLSL
#define RAYLAB_TRACE_BVH8Q_GLSL

#include "trace/two_level.glsl"

const uint kWordsNodeBvh8q = 5u;
const uint kSlotBitsBvh8q = 0x00ffffffu;

// Bits of the children that are hit among the four of `meta`: inner ones at 24 + (slot ^ flip), leaves' slots below 24.
uint hitBitsBvh8q(bvec4 hits, uint meta, uint flip) {
    uvec4 bytes = unpackBytes(meta);
    uvec4 low = bytes & 31u;
    uvec4 place = low ^ mix(uvec4(0u), uvec4(flip), greaterThanEqual(low, uvec4(24u)));
    uvec4 bits = mix(uvec4(0u), (bytes >> 5) << place, hits);
    return bits.x | bits.y | bits.z | bits.w;
}

bool findHit(Ray ray, bool anyHit, out Candidate hit) {
    hit = noCandidate(ray.tMax);
    ++tracedRays;
    if (frame.root == kTreeEnd) return false;
    SlabRay world = slabRay(ray.origin, ray.direction);
    ObjectRay object = ObjectRay(world, triangleRay(ray.origin, ray.direction), kInheritInstance);
    bool upper = needs(kNeedInstancing) && frame.hasUpperTree != 0u;
    uint stack[kStackSize];
    stack[0] = 0u;
    stack[1] = 0u;
    int top = 0;    // of the stack: the group that is popped next, two entries
    int floor = -1;  // below an instance: the topmost group of the upper tree; popping it leads back there
    uvec2 group = uvec2(frame.root, 1u << 31);  // no bits: the end of the walk
    uint slots = 0u;                            // to be tested, from firstSlot on
    uint firstSlot = 0u;
    bool slotsUpper = false;  // they are instances
    int tMin = floatBitsToInt(ray.tMin);
    while (true) {
        int tMax = floatBitsToInt(hit.t);
        while (slots == 0u && group.y > kSlotBitsBvh8q) {
            SlabRay slab = object.slab;
            if (needs(kNeedInstancing)) slab = selectSlabRay(upper, object.slab, world);
            uvec3 positive = mix(uvec3(1u, 2u, 4u), uvec3(0u), lessThan(slab.reciprocal, vec3(0.0)));
            uint flip = positive.x | positive.y | positive.z;
            // The nearest child of the group; the others go back onto the stack.
            uint bit = uint(findMSB(group.y));
            uint slot = (bit - 24u) ^ flip;
            uint node = group.x + uint(bitCount(group.y & ((1u << slot) - 1u)));
            group.y ^= 1u << bit;
            stack[top + 2] = group.x;
            stack[top + 3] = group.y;
            top += group.y > kSlotBitsBvh8q ? 2 : 0;
            int at = int(node * kWordsNodeBvh8q);
            uvec4 w0 = texelFetch(nodeWords, at);
            uvec4 w1 = texelFetch(nodeWords, at + 1);
            uvec4 w2 = texelFetch(nodeWords, at + 2);
            uvec4 w3 = texelFetch(nodeWords, at + 3);
            uvec4 w4 = texelFetch(nodeWords, at + 4);
            FrameRay boxes = frameRay(slab, w0);
            ivec4 near;
            bvec4 hits0 = frameSlabs(boxes, uvec3(w2.xz, w3.x), uvec3(w3.z, w4.xz), tMin, tMax, near);
            bvec4 hits1 = frameSlabs(boxes, uvec3(w2.yw, w3.y), uvec3(w3.w, w4.yw), tMin, tMax, near);
            uint hits = hitBitsBvh8q(hits0, w1.z, flip) | hitBitsBvh8q(hits1, w1.w, flip);
            countNode(8u, uint(bitCount(hits)), top + 1);  // two words an entry
            slots = hits & kSlotBitsBvh8q;
            firstSlot = w1.y;
            slotsUpper = upper;
            bool pop = hits <= kSlotBitsBvh8q;
            if (needs(kNeedInstancing)) upper = upper || (pop && top <= floor);
            uvec2 popped = uvec2(stack[top], stack[top + 1]);
            group = pop ? popped : uvec2(w1.x, (hits & ~kSlotBitsBvh8q) | (w0.w >> 24));
            top -= pop ? 2 : 0;
        }
        if (slots == 0u && group.y == 0u) break;
        if (needs(kNeedInstancing) && (slotsUpper || slots == 0u)) {
            // What is left of the node waits on the stack: inner children, then instances.
            if (slots == 0u) {
                firstSlot = group.x;
                slots = group.y;
            } else {
                top += 2;
                stack[top] = group.x;
                stack[top + 1] = group.y;
            }
            uint entered = firstSlot + uint(findLSB(slots));
            slots &= slots - 1u;
            if (slots != 0u) {
                top += 2;
                stack[top] = firstSlot;
                stack[top + 1] = slots;
            }
            countInstance();
            object = enterObject(ray, entered, group.x);
            group.y = 1u << 31;
            slots = 0u;
            slotsUpper = false;
            floor = top;
            upper = false;
            continue;
        }
        countLeafStep(top + 1);
        testSlotBits(ray, object, firstSlot, slots, hit);
        if (anyHit && hit.instance != kInheritInstance) return true;
    }
    return hit.instance != kInheritInstance;
}

#include "trace/interface.glsl"

#endif
