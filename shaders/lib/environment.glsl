// Radiance from infinitely far away: a constant, or a latitude-longitude map sampled by an alias table over its texels.
// The one mapping: u = 1/2 + atan(x, -z) / 2pi (the middle column looks along -Z, azimuth grows towards +X),
// v = acos(y) / pi (row 0 is up).
#ifndef RAYLAB_ENVIRONMENT_GLSL
#define RAYLAB_ENVIRONMENT_GLSL

#include "lib/convert.glsl"
#include "lib/sampling.glsl"
#include "lib/scene_buffers.glsl"

vec2 environmentUv(vec3 d) { return vec2(0.5 + atan(d.x, -d.z) * (0.5 * kInvPi), acos(clamp(d.y, -1.0, 1.0)) * kInvPi); }

// -1 <= cell <= size.
int environmentTexel(ivec2 cell) {
    int w = int(frame.environmentWidth), h = int(frame.environmentHeight);
    int x = cell.x < 0 ? cell.x + w : (cell.x >= w ? cell.x - w : cell.x);
    return clamp(cell.y, 0, h - 1) * w + x;
}

// Density over solid angle of a texel whose relative density over the map is `relative`.
float environmentPdf(float relative, float sinTheta) {
    return sinTheta > 0.0 ? relative / (2.0 * kPi * kPi * sinTheta) : 0.0;
}

// Radiance along d (bilinear) and the density with which sampleEnvironment chooses d: 0 for a constant, which scattering
// alone finds with less noise.
vec3 environmentRadiance(vec3 d, out float pdf) {
    if (frame.environmentWidth == 0u) {
        pdf = 0.0;
        return frame.environmentConstant;
    }
    vec2 size = vec2(frame.environmentWidth, frame.environmentHeight);
    vec2 at = environmentUv(d) * size;
    vec2 corner = floor(at - 0.5);
    vec2 f = at - 0.5 - corner;
    ivec2 cell = wholeToInt(corner);
    vec4 c00 = texelFetch(environmentTexels, environmentTexel(cell));
    vec4 c10 = texelFetch(environmentTexels, environmentTexel(cell + ivec2(1, 0)));
    vec4 c01 = texelFetch(environmentTexels, environmentTexel(cell + ivec2(0, 1)));
    vec4 c11 = texelFetch(environmentTexels, environmentTexel(cell + ivec2(1, 1)));
    vec4 radiance = mix(mix(c00, c10, f.x), mix(c01, c11, f.x), f.y);
    pdf = environmentPdf(radiance.w, sqrt(max(0.0, 1.0 - d.y * d.y)));
    return radiance.rgb;
}

vec3 environmentRadiance(vec3 d) {
    float pdf;
    return environmentRadiance(d, pdf);
}

// A direction in proportion to the map: `choice` picks a texel, `within` moves it by a tent, which makes the density the
// bilinear interpolation of the texels' own: exactly what environmentRadiance interpolates, small suns included.
vec3 sampleEnvironment(vec2 choice, vec2 within) {
    uint count = frame.environmentWidth * frame.environmentHeight;
    uint texel = min(uint(choice.x * float(count)), count - 1u);
    uvec2 entry = texelFetch(environmentAlias, int(texel)).xy;
    if (choice.y >= uintBitsToFloat(entry.x)) texel = entry.y;
    vec2 centre = vec2(divideByWidth(int(texel), int(frame.environmentWidth)).yx) + 0.5;
    vec2 at = centre + vec2(sampleTent(within.x), sampleTent(within.y));
    float height = float(frame.environmentHeight);
    at.y = at.y > height ? 2.0 * height - at.y : abs(at.y);  // rows beyond a pole repeat the last one
    vec2 uv = at / vec2(frame.environmentWidth, height);
    float theta = uv.y * kPi;
    float phi = (uv.x - 0.5) * 2.0 * kPi;
    return vec3(sin(theta) * sin(phi), cos(theta), -sin(theta) * cos(phi));
}

#endif
