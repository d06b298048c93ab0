// Keys that a queue is sorted by.
#ifndef RAYLAB_WAVEFRONT_SORT_KEYS_GLSL
#define RAYLAB_WAVEFRONT_SORT_KEYS_GLSL

#include "trace/common.glsl"
#include "wavefront/queues.glsl"

const uint kKeyCount = kQueueOrder == kOrderMaterial ? kMaterialKeys : (kQueueOrder == kOrderOctant ? kOctantKeys : kMostKeys);

uint octantOf(vec3 direction) {
    uvec3 negative = uvec3(lessThan(direction, vec3(0.0)));
    return negative.x | negative.y << 1 | negative.z << 2;
}

// Three bits, two apart.
uvec3 spreadBits(uvec3 x) { return (x & 1u) | (x & 2u) << 2 | (x & 4u) << 4; }

uint rayKey(Ray ray) {
    uint octant = octantOf(ray.direction);
    if (kQueueOrder == kOrderOctant) return octant;
    vec3 cell = clamp((ray.origin - push.cellOrigin) * push.cellScale, 0.0, float(kCellsPerAxis) - 1.0);
    // Whole numbers from the bits of a float: lavapipe converts one lane after the other.
    uvec3 bits = spreadBits(floatBitsToUint(floor(cell) + 8388608.0) & (kCellsPerAxis - 1u));
    return (bits.x | bits.y << 1 | bits.z << 2) << 3 | octant;
}

// Of what a ray came to; 0: nothing.
uint materialKey(bool isHit, uint instance) {
    return isHit ? min(loadInstanceHeader(instance).material + 1u, kMaterialKeys - 1u) : 0u;
}

// The path at `place` of the arrivals of a round has this key.
void putKey(uint round, uint place, uint key) {
    queueWords[arrayAt(kArrayKeys, place)] = key;
    atomicAdd(queueWords[keyCountAt(round, key)], 1u);
}

#endif
