// Software traversal of a 4-wide BVH of 48-byte blocks, each a node or a triangle (engine/accel/layout_bvh4b.h): boxes of
// 8 bits in a local frame, after Ylitie, Karras and Laine, HPG 2017. A step fetches one block and does with it what it is
// for: on lavapipe a fetch costs by its number and arithmetic is cheap, so that doing both in every step and taking the one
// result is faster than letting lanes wait for each other at nodes and at leaves; what no lane is at is left out by a vote, which is a
// jump there, and there is one loop, as a second would mask every store (docs/bvh.md). What is left of a node is one entry of the stack,
// children by distance. Two levels where the scene has instances.
#ifndef RAYLAB_TRACE_BVH4B_GLSL
#define RAYLAB_TRACE_BVH4B_GLSL

#include "trace/two_level.glsl"

const uint kLastBlock = 0x1ffffffu;  // that no tree contains: the end of the walk
const uint kNoChildren = 1u;         // a group's low bits: see walk_bvh4b.h
const uint kGroupBits = 7u;
const uint kGroupMask = 127u;
const int kNotHit = 0x7fffffff;

// The children of the node in w0 to w2 that the ray meets: their numbers, two bits each, nearest first, ended by a 1.
uint childrenBvh4b(SlabRay ray, uvec4 w0, uvec4 w1, uvec2 w2, int tMin, int tMax, bool isNode) {
    FrameRay frameOfNode = frameRay(ray, w0);
    bvec3 turned = lessThan(ray.reciprocal, vec3(0.0));
    uvec3 lo = uvec3(w1.x, w1.z, w2.x);
    uvec3 hi = uvec3(w1.y, w1.w, w2.y);
    uvec3 nearPlanes = mix(lo, hi, turned);
    uvec3 farPlanes = mix(hi, lo, turned);
    int last = isNode ? int((w0.w >> 24) & 3u) : -1;
    int keys[4];
    uint count = 0u;
    for (int i = 0; i < 4; ++i) {
        uint shift = 8u * uint(i);
        ivec3 t0 = floatBitsToInt(vec3((nearPlanes >> shift) & 0xffu) * frameOfNode.scale + frameOfNode.offset);
        ivec3 t1 = floatBitsToInt(vec3((farPlanes >> shift) & 0xffu) * frameOfNode.scale + frameOfNode.offset);
        int near = max(max(t0.x, t0.y), max(t0.z, tMin));
        int far = min(min(t1.x, t1.y), min(t1.z, tMax));
        bool isHit = near - kTreeSlabUlps <= far && i <= last;
        keys[i] = isHit ? (near & ~3) | i : kNotHit;
        count += uint(isHit);
    }
    int a = min(keys[0], keys[1]), b = max(keys[0], keys[1]);
    int c = min(keys[2], keys[3]), d = max(keys[2], keys[3]);
    int m = max(a, c), n = min(b, d);
    uvec4 sorted = uvec4(min(a, c), min(m, n), max(m, n), max(b, d)) & 3u;
    uint end = 1u << (2u * count);
    return ((sorted.x | sorted.y << 2 | sorted.z << 4 | sorted.w << 6) & (end - 1u)) | end;
}

// The triangle in a block. Its alpha is tested at once where any lane has to.
void testBlock(Ray ray, ObjectRay object, uvec4 w0, uvec4 w1, uvec4 w2, uvec4 w3, bool isTriangle, inout Candidate hit) {
    Candidate found = hit;
    considerTriangle(ray, object.triangle, w0, w1, w2, w3, object.instance, isTriangle, found);
    if (needs(kNeedAlpha) && subgroupAny(found.untested)) {
        if (found.untested && !acceptsUntested(found, ray.key)) found = hit;
        found.untested = false;
    }
    hit = found;
}

bool findHit(Ray ray, bool anyHit, out Candidate hit) {
    hit = noCandidate(ray.tMax);
    ++tracedRays;
    if (frame.root == kTreeEnd) return false;
    SlabRay world = slabRay(ray.origin, ray.direction);
    ObjectRay object = ObjectRay(world, triangleRay(ray.origin, ray.direction), kInheritInstance);
    bool upper = needs(kNeedInstancing) && frame.hasUpperTree != 0u;
    uint stack[kStackSize];
    stack[0] = (kLastBlock << kGroupBits) | (kNoChildren << 2);
    int top = 0;    // of the stack: the group that is popped next
    int floor = -1;  // below an instance: the topmost group of the upper tree; popping it leads back there
    uint group = kNoChildren;
    uint block = frame.root;
    int tMin = floatBitsToInt(ray.tMin);
    while (block != kLastBlock) {
        int at = int(block * kWordsTraceTriangle);
        uvec4 w0 = texelFetch(nodeWords, at);
        uvec4 w1 = texelFetch(nodeWords, at + 1);
        uvec4 w2 = texelFetch(nodeWords, at + 2);
        uvec4 w3 = uvec4(0u);
        if (kWordsTraceTriangle > 3u) w3 = texelFetch(nodeWords, at + 3);
        bool isLeaf = w0.w >= kBlockIsLeaf;
        bool enter = isLeaf && upper;
        bool isQuadric = needs(kNeedQuadrics) && isLeaf && !upper && (w0.w & kSlotIsQuadric) != 0u;
        bool isTriangle = isLeaf && !upper && !isQuadric;

        SlabRay slab = object.slab;
        if (needs(kNeedInstancing)) slab = selectSlabRay(upper, object.slab, world);
        uint children = childrenBvh4b(slab, w0, w1, w2.xy, tMin, floatBitsToInt(hit.t), !isLeaf);
        uint met = uint(findMSB(children)) >> 1;
        if (isLeaf)
            countLeafStep(top);
        else
            countNode(((w0.w >> 24) & 3u) + 1u, met, top);
        if (subgroupAny(isTriangle)) testBlock(ray, object, w0, w1, w2, w3, isTriangle, hit);
        if (needs(kNeedQuadrics) && subgroupAny(isQuadric)) {
            if (isQuadric) considerQuadric(ray, object.triangle, w0, w1, w2, object.instance, hit);
        }

        bool descend = children != kNoChildren;
        bool hasRest = (group & kGroupMask) != kNoChildren;
        bool push = hasRest && (descend || enter);
        bool pop = !hasRest && !descend && !enter;
        uint from = hasRest ? group : stack[top];
        stack[top + 1] = group;
        if (needs(kNeedInstancing)) upper = upper || (pop && top <= floor);
        top += push ? 1 : (pop ? -1 : 0);
        block = descend ? w2.z + (children & 3u) : (from >> kGroupBits) + (from & 3u);
        group = descend ? (w2.z << kGroupBits) | (children >> 2) : (from & ~kGroupMask) | ((from & kGroupMask) >> 2);
        if (needs(kNeedInstancing) && subgroupAny(enter)) {
            uint root;
            ObjectRay entered = enterObject(ray, enter ? w0.w & kInstanceMask : 0u, root);
            if (enter) {
                countInstance();
                object = entered;
                block = root;
                group = kNoChildren;
                floor = top;
                upper = false;
            }
        }
        if (anyHit && hit.instance != kInheritInstance) block = kLastBlock;
    }
    return hit.instance != kInheritInstance;
}

#include "trace/interface.glsl"

#endif
