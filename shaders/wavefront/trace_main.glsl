// Traces the rays of a round: of the paths, or of their light samples. Or follows what paths the last round left to their end.
#include "integrators/path.glsl"
#include "wavefront/path_state.glsl"
#include "wavefront/sort_keys.glsl"

void tracePath(uint at) {
    if (at >= queueLength(push.round)) return;
    uint path = queueWords[arrayAt(tracedArray(), at)];
    setPathTime(path);
    Hit hit;
    bool isHit = traceClosest(loadRay(path), hit);
    storeHit(path, hit, isHit);
    if (kQueueOrder == kOrderMaterial) putKey(push.round, at, materialKey(isHit, hit.instance));
}

void traceShadow(uint at) {
    if (at >= queueLength(kFirstShadowQueue + push.round)) return;
    vec4 origin = loadFloats(kShadowOrigin, at);
    uvec4 direction = loadWord(kShadowDirection, at), light = loadWord(kShadowLight, at);
    setPathTime(direction.w);
    if (traceOccluded(Ray(origin.xyz, 0.0, uintBitsToFloat(direction.xyz), origin.w, light.w))) return;
    vec4 radiance = loadFloats(kPathRadiance, direction.w);
    storeFloats(kPathRadiance, direction.w, vec4(radiance.xyz + uintBitsToFloat(light.xyz), radiance.w));
}

void finishPath(uint at) {
    if (at >= queueLength(push.round)) return;
    uint path = queueWords[arrayAt(arrivalArray(), at)];
    QueuedPath queued = loadPath(path);
    setRayTime(queued.random);
    queued.state.radiance = followPath(queued.state, queued.ray, queued.random);
    queued.rays += tracedRays;
    storeRadiance(path, queued);
}

void main() {
    uint at = groupIndex() * kWorkgroupSize + laneIndex();
    if (kStage == kStageClosest)
        tracePath(at);
    else if (kStage == kStageShadow)
        traceShadow(at);
    else
        finishPath(at);
}
