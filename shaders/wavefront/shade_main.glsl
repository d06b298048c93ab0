// From the hits of a round to the rays of the next one and to the shadow rays of this one.
#include "wavefront/enqueue.glsl"
#include "wavefront/path_state.glsl"
#include "wavefront/sort_keys.glsl"

void putPath(uint path, Ray ray, bool lives) {
    uint place = takePlace(push.round + 1u, lives);
    if (!lives) return;
    queueWords[arrayAt(arrivalArray() ^ 1u, place)] = path;
    if (kSortsRays) putKey(push.round + 1u, place, rayKey(ray));
}

void putShadowRay(uint path, ShadowRay shadow) {
    uint place = takePlace(kFirstShadowQueue + push.round, shadow.isAsked);
    if (!shadow.isAsked) return;
    storeFloats(kShadowOrigin, place, vec4(shadow.ray.origin, shadow.ray.tMax));
    storeWord(kShadowDirection, place, uvec4(floatBitsToUint(shadow.ray.direction), path));
    storeWord(kShadowLight, place, uvec4(floatBitsToUint(shadow.light), shadow.ray.key));
}

void main() {
    uint at = groupIndex() * kWorkgroupSize + laneIndex();
    uint path = 0u;
    bool lives = false;
    QueuedPath queued;
    ShadowRay shadow = kNoShadowRay;
    if (at < queueLength(push.round)) {
        path = queueWords[arrayAt(shadedArray(), at)];
        queued = loadPath(path);
        setRayTime(queued.random);
        Hit hit;
        bool isHit = loadHit(path, hit);
        lives = shadePath(queued.state, queued.ray, hit, isHit, queued.random, shadow);
        queued.rays += shadow.isAsked ? 2u : 1u;
        storeRadiance(path, queued);
        if (lives) storePath(path, queued);
    }
    putPath(path, queued.ray, lives);
    if (needs(kNeedLights)) putShadowRay(path, shadow);
}
