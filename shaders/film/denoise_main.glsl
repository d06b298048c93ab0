// A level of an edge-avoiding a-trous wavelet (Dammertz et al., "Edge-Avoiding A-Trous Wavelet Transform for fast Global
// Illumination Filtering", HPG 2010) over light that is divided by the surface's colour, steered by the variance of each
// pixel: Schied et al., "Spatiotemporal Variance-Guided Filtering", HPG 2017, sections 4.3 and 4.4. A picture stands still,
// so the variance is that of its own samples instead of a history's. The more samples, the less is filtered.
#include "lib/sampling.glsl"

layout(set = 0, binding = kBindDenoiseLight) uniform samplerBuffer lightTexels;  // light over colour; variance of its luminance, or kDenoiseUnknown, kDenoiseEmpty
layout(set = 0, binding = kBindDenoiseGuides) uniform samplerBuffer guideTexels;  // mean normal, mean depth of the first hits
layout(set = 0, binding = kBindDenoiseResult, std430) writeonly buffer ResultBlock { vec4 result[]; };
layout(push_constant) uniform PushBlock { DenoisePush push; };

const float kSigmaLight = 2.5;    // standard deviations by which light may differ: the paper's 4 costs more detail than it gains from 32 samples on
const float kSigmaNormal = 64.0;  // power of the cosine between normals, which averages over a pixel shorten
const float kSigmaDepth = 1.0;    // slopes of the depth
const float kLeastSlope = 1e-3;   // of the depth, relative to it: surfaces seen head-on
const float kTiny = 1e-10;

int indexAt(ivec2 p) { return p.y * int(push.width) + p.x; }
bool isInside(ivec2 p) { return p.x >= 0 && p.y >= 0 && p.x < int(push.width) && p.y < int(push.height); }
ivec2 clampToStrip(ivec2 p) { return clamp(p, ivec2(0), ivec2(push.width, push.height) - 1); }
vec4 lightAt(ivec2 p) { return texelFetch(lightTexels, indexAt(p)); }
vec4 guideAt(ivec2 p) { return texelFetch(guideTexels, indexAt(p)); }

// By how much the depth changes from a pixel to the next, along both axes: the lesser of both sides, lest an edge count.
vec2 depthSlope(ivec2 p, float depth) {
    float left = abs(guideAt(clampToStrip(p - ivec2(1, 0))).w - depth), right = abs(guideAt(clampToStrip(p + ivec2(1, 0))).w - depth);
    float up = abs(guideAt(clampToStrip(p - ivec2(0, 1))).w - depth), down = abs(guideAt(clampToStrip(p + ivec2(0, 1))).w - depth);
    // At the border of the picture one side is the pixel itself.
    vec2 size = vec2(push.width, push.height) - 1.0;
    float x = p.x == 0 ? right : float(p.x) == size.x ? left : min(left, right);
    float y = p.y == 0 ? down : float(p.y) == size.y ? up : min(up, down);
    return vec2(x, y);
}

// How far, as an exponent, the first hits of two pixels are from being on the same smooth surface.
float surfaceDistance(vec4 a, vec4 b, float slope) {
    float cosine = dot(a.xyz, b.xyz) * inversesqrt(max(dot(a.xyz, a.xyz) * dot(b.xyz, b.xyz), kTiny));
    return kSigmaNormal * max(1.0 - cosine, 0.0) + abs(a.w - b.w) / (kSigmaDepth * slope + kLeastSlope * a.w + kTiny);
}

// Binomial mean of the variances of 3 x 3 pixels: that of one pixel is noisy itself.
float smoothVariance(ivec2 p) {
    float sum = 0.0, weights = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            float variance = lightAt(clampToStrip(p + ivec2(x, y))).w;
            if (variance < 0.0) continue;
            float weight = float((2 - abs(x)) * (2 - abs(y)));
            sum += weight * variance;
            weights += weight;
        }
    return sum / max(weights, 1.0);
}

vec4 estimate(ivec2 p) {
    vec4 light = lightAt(p), guide = guideAt(p);
    if (light.w != kDenoiseUnknown) return light;
    vec2 slope = depthSlope(p, guide.w);
    float weights = 0.0, mean = 0.0, square = 0.0;
    int reach = int(kDenoiseWindow);
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            ivec2 q = p + ivec2(x, y);
            if (!isInside(q)) continue;
            vec4 other = lightAt(q);
            if (other.w == kDenoiseEmpty) continue;
            float weight = exp(-surfaceDistance(guide, guideAt(q), dot(slope, abs(vec2(x, y)))));
            float value = luminance(other.xyz);
            weights += weight;
            mean += weight * value;
            square += weight * value * value;
        }
    mean /= weights;
    return vec4(light.xyz, max(square / weights - mean * mean, 0.0));
}

vec4 filtered(ivec2 p) {
    vec4 light = lightAt(p), guide = guideAt(p);
    vec2 slope = depthSlope(p, guide.w) * float(push.spacing);
    float own = luminance(light.xyz);
    // What has no light takes that of its surface.
    float lightScale = light.w == kDenoiseEmpty ? 0.0 : 1.0 / (kSigmaLight * sqrt(smoothVariance(p)) + kTiny);
    const float kernel[3] = float[3](0.375, 0.25, 0.0625);  // of a cubic B-spline
    float weights = 0.0;
    vec4 sum = vec4(0.0);
    int reach = int(kDenoiseReach);
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            ivec2 q = p + ivec2(x, y) * int(push.spacing);
            if (!isInside(q)) continue;
            vec4 other = lightAt(q);
            if (other.w == kDenoiseEmpty) continue;
            float distance = surfaceDistance(guide, guideAt(q), dot(slope, abs(vec2(x, y)))) +
                             abs(luminance(other.xyz) - own) * lightScale;
            float weight = kernel[abs(x)] * kernel[abs(y)] * exp(-distance);
            weights += weight;
            sum += vec4(other.xyz * weight, other.w * weight * weight);
        }
    return weights > 0.0 ? vec4(sum.xyz / weights, sum.w / (weights * weights)) : light;
}

void main() {
    uint lane = groupIndex() * kWorkgroupSize + laneIndex();
    if (lane >= push.pixelCount) return;
    uint pixel = push.firstPixel + lane;
    ivec2 p = ivec2(pixel % push.width, pixel / push.width);
    result[pixel] = push.task == kDenoiseEstimate ? estimate(p) : filtered(p);
}
