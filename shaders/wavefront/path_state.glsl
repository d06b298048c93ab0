// The state of a path between kernels. What the scene does not need is neither stored nor loaded.
#ifndef RAYLAB_WAVEFRONT_PATH_STATE_GLSL
#define RAYLAB_WAVEFRONT_PATH_STATE_GLSL

#include "integrators/path_bounce.glsl"
#include "wavefront/queues.glsl"

struct QueuedPath {
    PathState state;
    Ray ray;
    Sampler random;
    uint rays;  // traced for it
};

Sampler samplerOf(uvec4 sampleWord) {
    return makeSampler(frame.seed, uvec2(sampleWord.x & 0xffffu, sampleWord.x >> 16), frame.width, sampleWord.y);
}

// Each kernel sees the scene when the path's sample is taken.
void setPathTime(uint path) {
    if (needs(kNeedMotion)) setRayTime(samplerOf(loadWord(kPathSample, path)));
}

// Boundaries that are passed unseen are no bounces: only where there are any do paths of a round differ.
uint bounceAt(uint path) {
    return needs(kNeedNesting) ? loadWord(mediumWord(kLightTree), path).w : push.round;
}

// The ray as the traversal wants it; a key where alpha is tested.
Ray loadRay(uint path) {
    uint key = 0u;
    if (needs(kNeedAlpha)) key = pathTraceKey(samplerOf(loadWord(kPathSample, path)), bounceAt(path));
    return Ray(loadFloats(kPathOrigin, path).xyz, 0.0, loadFloats(kPathDirection, path).xyz, kInfinity, key);
}

void storeHit(uint path, Hit hit, bool isHit) {
    uint instance = isHit ? hit.instance : kInheritInstance;
    storeWord(kPathHit, path, uvec4(floatBitsToUint(vec3(hit.t, hit.barycentrics)), instance));
    stateWords[kPathDirection * push.capacity + path].w = hit.primitive;
}

bool loadHit(uint path, out Hit hit) {
    uvec4 word = loadWord(kPathHit, path);
    vec3 t = uintBitsToFloat(word.xyz);
    hit = Hit(t.x, t.yz, word.w, stateWords[kPathDirection * push.capacity + path].w);
    return word.w != kInheritInstance;
}

Media loadMedia(uint path) {
    Media media = mediaInAir();
    uint word = mediaWord(kNeeds, kLightTree);
    if (needs(kNeedAbsorption | kNeedNesting)) media.absorption = loadFloats(mediumWord(kLightTree), path).xyz;
    if (needs(kNeedNesting)) {
        media.material = loadWord(word, path);
        media.ior = loadFloats(word + 1u, path);
        media.priority = loadFloats(word + 2u, path);
    }
    return media;
}

void storeMedia(uint path, Media media, uint bounce) {
    uint word = mediaWord(kNeeds, kLightTree);
    if (needs(kNeedAbsorption | kNeedNesting))
        storeWord(mediumWord(kLightTree), path, uvec4(floatBitsToUint(media.absorption), bounce));
    if (needs(kNeedNesting)) {
        storeWord(word, path, media.material);
        storeFloats(word + 1u, path, media.ior);
        storeFloats(word + 2u, path, media.priority);
    }
}

QueuedPath loadPath(uint path) {
    uvec4 origin = loadWord(kPathOrigin, path);
    vec4 throughput = loadFloats(kPathThroughput, path), radiance = loadFloats(kPathRadiance, path);
    uvec4 sampleWord = loadWord(kPathSample, path);
    Receiver receiver = Receiver(vec3(0.0), vec3(0.0));
    if (kLightTree != 0u)
        receiver = Receiver(loadFloats(kPathReceiver, path).xyz, loadFloats(kPathReceiver + 1u, path).xyz);
    QueuedPath queued;
    vec2 cone = uintBitsToFloat(sampleWord.zw);
    queued.state = PathState(throughput.xyz, radiance.xyz, throughput.w, radiance.w, receiver, RayCone(cone.x, cone.y),
                             loadMedia(path), bounceAt(path));
    queued.random = samplerOf(sampleWord);
    uint key = needs(kNeedAlpha) ? pathTraceKey(queued.random, queued.state.bounce) : 0u;
    queued.ray = Ray(uintBitsToFloat(origin.xyz), 0.0, loadFloats(kPathDirection, path).xyz, kInfinity, key);
    queued.rays = origin.w;
    return queued;
}

// What the film wants to know of a path.
void storeRadiance(uint path, QueuedPath queued) {
    storeWord(kPathOrigin, path, uvec4(floatBitsToUint(queued.ray.origin), queued.rays));
    storeFloats(kPathRadiance, path, vec4(queued.state.radiance, queued.state.etaScale));
}

void storeSample(uint path, Sampler random, RayCone cone) {
    storeWord(kPathSample, path,
              uvec4(random.pixel.y << 16 | random.pixel.x, random.index, floatBitsToUint(cone.width), floatBitsToUint(cone.spread)));
}

// What its next round wants to know besides.
void storePath(uint path, QueuedPath queued) {
    PathState state = queued.state;
    storeFloats(kPathDirection, path, vec4(queued.ray.direction, 0.0));
    storeFloats(kPathThroughput, path, vec4(state.throughput, state.scatterPdf));
    if (needs(kNeedTextures)) storeSample(path, queued.random, state.cone);
    if (kLightTree != 0u) {
        storeFloats(kPathReceiver, path, vec4(state.receiver.position, 0.0));
        storeFloats(kPathReceiver + 1u, path, vec4(state.receiver.normal, 0.0));
    }
    storeMedia(path, state.media, state.bounce);
}

#endif
