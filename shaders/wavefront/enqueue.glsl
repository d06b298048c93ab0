// Places at the end of a queue. All lanes of a subgroup come here together.
#ifndef RAYLAB_WAVEFRONT_ENQUEUE_GLSL
#define RAYLAB_WAVEFRONT_ENQUEUE_GLSL

#include "wavefront/queues.glsl"

// A place for each lane that wants one; side by side in a subgroup, so that a path's neighbours stay its neighbours. The
// queue's dispatch grows with it.
uint takePlace(uint queue, bool wants) {
    uvec4 wanting = subgroupBallot(wants);
    uint count = subgroupBallotBitCount(wanting);
    uint first = 0u;
    if (subgroupElect() && count > 0u) {
        first = atomicAdd(queueWords[kArgumentWords * queue + 3u], count);
        atomicMax(queueWords[kArgumentWords * queue], (first + count + kWorkgroupSize - 1u) / kWorkgroupSize);
    }
    return subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(wanting);
}

#endif
