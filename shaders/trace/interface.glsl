// The two functions that integrators see, over a software traversal's findHit.
#ifndef RAYLAB_TRACE_INTERFACE_GLSL
#define RAYLAB_TRACE_INTERFACE_GLSL

bool traceClosest(Ray ray, out Hit hit) {
    Candidate found;
    bool any = findHit(ray, false, found);
    hit = Hit(found.t, found.barycentrics, found.instance, found.primitive);
    return any;
}

bool traceOccluded(Ray ray) {
    Candidate found;
    return findHit(ray, true, found);
}

#endif
