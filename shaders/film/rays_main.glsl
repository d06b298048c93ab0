// Traces a list of rays: what tests, benchmarks and comparisons of traversals run.
layout(local_size_x = kWorkgroupSize) in;
layout(set = 0, binding = kBindRays, std430) readonly buffer RayBlock { RayData rays[]; };
layout(set = 0, binding = kBindHits, std430) writeonly buffer HitBlock { HitData hits[]; };
layout(push_constant) uniform PushBlock { RaysPush push; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    RayData data = rays[i];
    Ray ray = Ray(data.origin, data.tMin, data.direction, data.tMax, i);
    HitData result = HitData(-1.0, 0.0, 0.0, 0u, 0u, 0u, 0u, 0u);
    if (push.anyHit != 0u) {
        if (traceOccluded(ray)) result.t = 1.0;
    } else {
        Hit hit;
        if (traceClosest(ray, hit))
            result = HitData(hit.t, hit.barycentrics.x, hit.barycentrics.y, hit.instance, hit.primitive, 0u, 0u, 0u);
    }
    hits[i] = result;
}
