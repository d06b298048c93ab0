// traceClosest and traceOccluded of a software traversal over its findHit. Alpha is tested outside the walk: a hit that
// it refuses starts the search again behind that hit. Inside the leaf loop the test would cost every ray its texture
// fetches, since lavapipe runs both sides of a branch.
#ifndef RAYLAB_REFINE_GLSL
#define RAYLAB_REFINE_GLSL

bool findAccepted(Ray ray, bool anyHit, out Candidate hit) {
    Cursor after = kFromStart;
    while (findHit(ray, anyHit, after, hit)) {
        if (!needs(kNeedAlpha) || !hit.alphaTested) return true;
        if (acceptsCandidate(hit.instance, hit.primitive, hit.barycentrics, ray.key)) return true;
        ray.tMin = hit.t;
        after = Cursor(hit.instance, hit.primitive);
    }
    return false;
}

bool traceClosest(Ray ray, out Hit hit) {
    Candidate found;
    bool any = findAccepted(ray, false, found);
    hit = Hit(found.t, found.barycentrics, found.instance, found.primitive);
    return any;
}

bool traceOccluded(Ray ray) {
    Candidate found;
    return findAccepted(ray, true, found);
}

#endif
