// Software traversal of a 4-wide BVH with 48-byte nodes: boxes of 8 bits in a local frame, after Ylitie, Karras and
// Laine, HPG 2017; three uvec4 fetches a node (engine/accel/layout_bvh4q.h, walk_bvh4q.h). One entry of the stack holds
// all inner children that are left of a node, nearest first, so a step makes one access each way, as in a binary tree.
// The leaves of a node wait in registers and are tested nearest first before the walk goes on. Two levels where the
// scene has instances.
#ifndef RAYLAB_TRACE_BVH4Q_GLSL
#define RAYLAB_TRACE_BVH4Q_GLSL

#include "trace/two_level.glsl"

const uint kWordsNodeBvh4q = 3u;
const uint kNoKeyBvh4q = 0xffffffffu;
const uint kIndexMaskBvh4q = 0x0fffffffu;

// Leaves of one node that are still to be tested. A key: the distance's bits with the child's number in the lowest two.
struct LeavesBvh4q {
    uvec4 keys;   // nearest first; kNoKeyBvh4q: none
    uint first;   // bits 0 to 27: first slot of the first leaf; from 28 on, a bit a child: is inner
    uint counts;  // from bit 24 on two bits a child: slots - 1
    bool upper;   // of the tree over instances
};

const LeavesBvh4q kNoLeavesBvh4q = LeavesBvh4q(uvec4(kNoKeyBvh4q), 0u, 0u, false);

uvec4 sortKeysBvh4q(uvec4 k) {
    uvec2 lo = min(k.xz, k.yw);
    uvec2 hi = max(k.xz, k.yw);
    uint a = max(lo.x, lo.y);
    uint b = min(hi.x, hi.y);
    return uvec4(min(lo.x, lo.y), min(a, b), max(a, b), max(hi.x, hi.y));
}

// A group on the stack: bits 6 to 30 the first inner child, below up to three children of two bits each; where one
// repeats, the list ended before it.
uint groupBvh4q(uint firstChild, uvec4 keys) {
    uint a = keys.y & 3u;
    uint b = keys.z != kNoKeyBvh4q ? keys.z & 3u : a;
    uint c = keys.w != kNoKeyBvh4q ? keys.w & 3u : b;
    return (firstChild << 6) | (c << 4) | (b << 2) | a;
}

uint groupRestBvh4q(uint group) { return (group & ~15u) | ((group >> 2) & 15u); }

bool groupIsLastBvh4q(uint group) { return ((group ^ (group >> 2)) & 3u) == 0u; }

// Child reference of the leaf with this key.
uint leafBvh4q(LeavesBvh4q leaves, uint key) {
    uint child = key & 3u;
    uvec4 each = ((uvec4(leaves.counts) >> uvec4(24u, 26u, 28u, 30u)) & 3u) + 1u;
    bvec4 before = lessThan(uvec4(0u, 1u, 2u, 3u), uvec4(child));
    bvec4 isInner = notEqual(uvec4(leaves.first) & uvec4(1u << 28, 1u << 29, 1u << 30, 1u << 31), uvec4(0u));
    uvec4 counted = mix(mix(uvec4(0u), each, before), uvec4(0u), isInner);
    uint first = (leaves.first & kIndexMaskBvh4q) + counted.x + counted.y + counted.z + counted.w;
    return kTreeLeafBit | (((leaves.counts >> (24u + 2u * child)) & 3u) << kTreeLeafCountShift) | first;
}

// Drops the nearest leaf, and all others where the next begins behind the hit.
void nextLeafBvh4q(inout LeavesBvh4q leaves, float tMax) {
    leaves.keys = uvec4(leaves.keys.yzw, kNoKeyBvh4q);
    if (int(leaves.keys.x & ~3u) - kTreeSlabUlps > floatBitsToInt(tMax)) leaves.keys = uvec4(kNoKeyBvh4q);
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
    LeavesBvh4q leaves = kNoLeavesBvh4q;
    uint tested = 0u;  // slots of the nearest of the leaves
    int tMin = floatBitsToInt(ray.tMin);
    while (true) {
        int tMax = floatBitsToInt(hit.t);
        while (node < kTreeLeafBit && leaves.keys.x == kNoKeyBvh4q) {
            int at = int(node * kWordsNodeBvh4q);
            uvec4 w0 = texelFetch(nodeWords, at);
            uvec4 w1 = texelFetch(nodeWords, at + 1);
            uvec4 w2 = texelFetch(nodeWords, at + 2);
            SlabRay slab = object.slab;
            if (needs(kNeedInstancing)) slab = selectSlabRay(upper, object.slab, world);
            ivec4 near;
            bvec4 hits = frameSlabs(frameRay(slab, w0), w1.xyz, uvec3(w1.w, w2.xy), tMin, tMax, near);
            uvec4 bits = uvec4(1u << 28, 1u << 29, 1u << 30, 1u << 31);
            uvec4 reached = mix(uvec4(0u), uvec4(w2.z) & bits, hits);  // children that exist
            uvec4 tests = uvec4(notEqual(uvec4(w2.z) & bits, uvec4(0u))), met = uvec4(notEqual(reached, uvec4(0u)));
            countNode(tests.x + tests.y + tests.z + tests.w, met.x + met.y + met.z + met.w, top);
            uvec4 keys = (uvec4(near) & ~3u) | uvec4(0u, 1u, 2u, 3u);
            uvec4 inner = sortKeysBvh4q(mix(uvec4(kNoKeyBvh4q), keys, notEqual(reached & w2.w, uvec4(0u))));
            leaves.keys = sortKeysBvh4q(mix(uvec4(kNoKeyBvh4q), keys, notEqual(reached & ~w2.w, uvec4(0u))));
            leaves.first = w2.w;
            leaves.counts = w0.w;
            leaves.upper = upper;
            // The nearest inner child next, its siblings onto the stack; without any, the next of the group on top.
            uint firstChild = w2.z & kIndexMaskBvh4q;
            bool pop = inner.x == kNoKeyBvh4q;
            uint popped = stack[top];
            bool isGroup = popped < kTreeLeafBit;
            if (needs(kNeedInstancing)) upper = upper || (pop && top <= floor);
            stack[pop ? top : top + 1] = pop ? groupRestBvh4q(popped) : groupBvh4q(firstChild, inner);
            node = pop ? (isGroup ? (popped >> 6) + (popped & 3u) : popped) : firstChild + (inner.x & 3u);
            bool shrinks = pop && (!isGroup || groupIsLastBvh4q(popped));
            top += inner.y != kNoKeyBvh4q ? 1 : (shrinks ? -1 : 0);
        }
        bool waiting = leaves.keys.x != kNoKeyBvh4q;
        if (!waiting && node == kTreeEnd) break;
        if (needs(kNeedInstancing) && (leaves.upper || !waiting)) {
            // What is left of the node waits on the stack: inner children, then leaves, then the rest of this leaf.
            uint reference = node;
            if (waiting) {
                stack[++top] = node < kTreeLeafBit ? node << 6 : node;
                for (int i = 3; i > 0; --i)
                    if (leaves.keys[i] != kNoKeyBvh4q) stack[++top] = leafBvh4q(leaves, leaves.keys[i]);
                reference = leafBvh4q(leaves, leaves.keys.x);
                leaves = kNoLeavesBvh4q;
            }
            if (((reference >> kTreeLeafCountShift) & 15u) != 0u)
                stack[++top] = reference - (1u << kTreeLeafCountShift) + 1u;
            countInstance();
            object = enterObject(ray, reference & kTreeLeafFirstMask, node);
            floor = top;
            upper = false;
            continue;
        }
        countLeafStep(top);
        uint reference = leafBvh4q(leaves, leaves.keys.x);
        uint first = reference & kTreeLeafFirstMask;
        uint last = first + ((reference >> kTreeLeafCountShift) & 15u);
        uint slot = first + tested;
        testSlots(ray, object, slot, last, hit);
        if (anyHit && hit.instance != kInheritInstance) return true;
        if (needs(kNeedAlpha) && slot <= last) {
            tested = slot - first;
            continue;
        }
        tested = 0u;
        nextLeafBvh4q(leaves, hit.t);
    }
    return hit.instance != kInheritInstance;
}

#include "trace/interface.glsl"

#endif
