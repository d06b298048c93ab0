// The traversal of the layout that the kernel is specialised to.
#ifndef RAYLAB_TRACE_SOFTWARE_GLSL
#define RAYLAB_TRACE_SOFTWARE_GLSL

#include "trace/bvh2.glsl"
#include "trace/bvh2q.glsl"
#include "trace/bvh4b.glsl"
#include "trace/bvh4q.glsl"
#include "trace/bvh8q.glsl"

bool findHit(Ray ray, bool anyHit, out Candidate hit) {
    if (kLayout == kLayoutBvh2) return findHitBvh2(ray, anyHit, hit);
    if (kLayout == kLayoutBvh2q) return findHitBvh2q(ray, anyHit, hit);
    if (kLayout == kLayoutBvh4q) return findHitBvh4q(ray, anyHit, hit);
    if (kLayout == kLayoutBvh8q) return findHitBvh8q(ray, anyHit, hit);
    return findHitBvh4b(ray, anyHit, hit);
}

#include "trace/interface.glsl"

#endif
