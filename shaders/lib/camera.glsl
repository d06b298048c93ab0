// Pinhole and thin-lens camera (methods.md, "Common").
#ifndef RAYLAB_CAMERA_GLSL
#define RAYLAB_CAMERA_GLSL

#include "lib/filter.glsl"
#include "lib/sampler.glsl"
#include "trace/common.glsl"

layout(constant_id = kSpecThinLens) const uint kThinLens = 0;
layout(constant_id = kSpecAntialias) const uint kAntialias = kAntialiasFilter;
layout(constant_id = kSpecCameraMotion) const uint kCameraMotion = 0;

// Pairs of dimensions that the camera takes: an integrator has the others.
const uint kPairPixel = 0u;
const uint kPairLens = 1u;

// Scaled as in FrameParams.
struct CameraPose {
    vec3 position;
    vec3 right;
    vec3 up;
    vec3 forward;
};

// The camera when a sample is taken: its position, and the image at distance 1 before it, move in straight lines.
CameraPose cameraPose(Sampler random) {
    CameraPose start = CameraPose(frame.cameraPosition, frame.cameraRight, frame.cameraUp, frame.cameraForward);
    if (kCameraMotion == 0u) return start;
    float time = sampleTime(random);
    return CameraPose(mix(start.position, frame.endPosition, time), mix(start.right, frame.endRight, time),
                      mix(start.up, frame.endUp, time), mix(start.forward, frame.endForward, time));
}

// From the middle of the lens through a point of the image, at distance 1 along the axis.
vec3 cameraVector(CameraPose pose, uvec2 pixel, vec2 jitter) {
    vec2 ndc = (vec2(pixel) + jitter) / vec2(frame.width, frame.height) * 2.0 - 1.0;
    return pose.forward + ndc.x * pose.right - ndc.y * pose.up;
}

// Through a point of the lens to where the plane of focus has the image's point (Cook, Porter, Carpenter, "Distributed Ray
// Tracing", SIGGRAPH 1984).
Ray thinLensRay(CameraPose pose, uvec2 pixel, vec2 jitter, vec2 u) {
    vec2 lens = frame.lensRadius * sampleDisc(u);
    vec3 offset = lens.x * normalize(pose.right) + lens.y * normalize(pose.up);
    vec3 direction = normalize(frame.focusDistance * cameraVector(pose, pixel, jitter) - offset);
    return Ray(pose.position + offset, 0.0, direction, kInfinity, 0u);
}

// Where in its pixel a sample lies: by the filter, in the middle, or at (+-1/4, +-1/4) of it in turn.
vec2 pixelPosition(Sampler random) {
    if (kAntialias == kAntialiasCentre) return vec2(0.5);
    if (kAntialias == kAntialiasGrid)
        return vec2((random.index & 1u) != 0u ? 0.75 : 0.25, (random.index & 2u) != 0u ? 0.75 : 0.25);
    return sampleFilter(sample2D(random, kPairPixel));
}

Ray cameraRay(uvec2 pixel, Sampler random) {
    vec2 jitter = pixelPosition(random);
    CameraPose pose = cameraPose(random);
    if (kThinLens != 0u) return thinLensRay(pose, pixel, jitter, sample2D(random, kPairLens));
    return Ray(pose.position, 0.0, normalize(cameraVector(pose, pixel, jitter)), kInfinity, 0u);
}

#endif
