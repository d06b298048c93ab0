// Sorts a round's paths by their keys, by counting. Within a key the order is left open: no path's result depends on it.
#include "wavefront/sort_keys.glsl"

shared uint totals[kWorkgroupSize];

// One group: the first place of each key, from how many there are. The other round's counts begin again.
void scanCounts() {
    uint keysPerLane = kKeyCount / kWorkgroupSize;
    uint first = laneIndex() * keysPerLane;
    uint total = 0u;
    for (uint i = 0u; i < keysPerLane; ++i) total += queueWords[keyCountAt(push.round, first + i)];
    totals[laneIndex()] = total;
    barrier();
    uint place = 0u;
    for (uint i = 0u; i < laneIndex(); ++i) place += totals[i];
    for (uint i = 0u; i < keysPerLane; ++i) {
        uint at = keyCountAt(push.round, first + i);
        uint count = queueWords[at];
        queueWords[at] = place;
        place += count;
        queueWords[keyCountAt(push.round + 1u, first + i)] = 0u;
    }
}

void scatterPaths(uint at) {
    if (at >= queueLength(push.round)) return;
    uint key = queueWords[arrayAt(kArrayKeys, at)];
    uint place = atomicAdd(queueWords[keyCountAt(push.round, key)], 1u);
    queueWords[arrayAt(kArraySorted, place)] = queueWords[arrayAt(arrivalArray(), at)];
}

void main() {
    if (kStage == kStageScan)
        scanCounts();
    else
        scatterPaths(groupIndex() * kWorkgroupSize + laneIndex());
}
