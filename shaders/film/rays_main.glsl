// Traces a list of rays: what tests, benchmarks and comparisons of traversals run.
layout(set = 0, binding = kBindRays) uniform samplerBuffer rayWords;
layout(set = 0, binding = kBindHits, std430) writeonly buffer HitBlock { HitData hits[]; };
layout(set = 0, binding = kBindCounts, std430) writeonly buffer CountBlock { RayCounts counts[]; };
layout(push_constant) uniform PushBlock { RaysPush push; };

void main() {
    uint i = groupIndex() * kWorkgroupSize + laneIndex();
    if (i >= push.count) return;
    vec4 origin = texelFetch(rayWords, int(i * kWordsRay));
    vec4 direction = texelFetch(rayWords, int(i * kWordsRay + 1u));
    Ray ray = Ray(origin.xyz, origin.w, direction.xyz, direction.w, i);
    // Only what the answer needs: a store is done lane by lane too. The host fills in the rest.
    if (push.anyHit != 0u) {
        hits[i].t = traceOccluded(ray) ? 1.0 : -1.0;
    } else {
        Hit hit;
        bool any = traceClosest(ray, hit);
        hits[i].t = any ? hit.t : -1.0;
        if (any) {
            hits[i].u = hit.barycentrics.x;
            hits[i].v = hit.barycentrics.y;
            hits[i].instance = hit.instance;
            hits[i].primitive = hit.primitive;
        }
    }
    if (kCount != 0u) counts[i] = counted;
}
