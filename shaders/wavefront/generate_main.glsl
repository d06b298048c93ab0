// A path for each sample of each pixel of the slice. A sample's paths lie side by side, `lanes` of them.
#include "film/pixel_work.glsl"
#include "lib/camera.glsl"
#include "wavefront/enqueue.glsl"
#include "wavefront/path_state.glsl"

void startSample(uint path, uvec2 pixel, uint sampleIndex) {
    Sampler random = makeSampler(frame.seed, pixel, frame.width, sampleIndex);
    QueuedPath queued = QueuedPath(startPath(RayCone(0.0, frame.pixelSpread)), cameraRay(pixel, random), random, 0u);
    storeRadiance(path, queued);
    storePath(path, queued);
    storeSample(path, random, queued.state.cone);
}

void main() {
    PixelWork work;
    bool isPixel = findPixelWork(push.slice, groupIndex(), laneIndex(), work);
    uint lane = groupIndex() * kWorkgroupSize + laneIndex() - push.slice.firstLane;
    for (uint i = 0u; i < push.pathsPerLane; ++i) {
        uint path = i * push.lanes + lane;
        bool isSample = isPixel && work.first + i < work.end;
        if (isSample) startSample(path, work.pixel, work.first + i);
        uint place = takePlace(0u, isSample);
        if (isSample) queueWords[arrayAt(0u, place)] = path;
    }
}
