// Textures from one texel buffer: every texture of the scene is within reach of the one kernel, whatever the device's
// limit on descriptors. Filter: bilinear in linear light at one level; the level is chosen by a ray cone
// (Akenine-Moller et al., "Improved Shader and Texture Level of Detail Using Ray Cones", JCGT 10(1), 2021) and rounded at
// random, which is trilinear filtering in expectation at half its fetches.
#ifndef RAYLAB_TEXTURE_GLSL
#define RAYLAB_TEXTURE_GLSL

#include "lib/scene_buffers.glsl"

vec3 srgbToLinear(vec3 c) {
    return mix(c * (1.0 / 12.92), pow((c + 0.055) * (1.0 / 1.055), vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

int wrapTexel(int x, int size, uint mode) {
    if (mode == 1u) return clamp(x, 0, size - 1);
    int period = mode == 2u ? 2 * size : size;
    int m = x % period;
    m = m < 0 ? m + period : m;
    return m < size ? m : period - 1 - m;
}

vec4 decodeTexel(uint packed, bool srgb) {
    vec4 c = unpackUnorm4x8(packed);
    return srgb ? vec4(srgbToLinear(c.rgb), c.a) : c;
}

// `lod`: level of detail before rounding; `u` rounds it.
vec4 sampleTexture(uint index, vec2 uv, float lod, float u) {
    uvec4 header = texelFetch(textureWords, int(index));
    uint levels = (header.w >> kTextureLevelShift) & 31u;
    uint level = uint(clamp(floor(lod + u), 0.0, float(levels - 1u)));
    int base = int(header.x);
    ivec2 size = ivec2(header.yz);
    for (uint i = 0u; i < level; ++i) {
        base += size.x * size.y;
        size = max(size >> 1, ivec2(1));
    }
    bool srgb = (header.w & kTextureSrgb) != 0u;
    uint wrapU = header.w & 3u;
    uint wrapV = (header.w >> 2) & 3u;
    vec2 whole = floor(uv);  // keeps the precision of the fraction for coordinates far from the origin
    vec2 at = (uv - whole) * vec2(size) - 0.5;
    ivec2 cell = ivec2(floor(at));
    vec2 f = at - vec2(cell);
    cell += ivec2(clamp(whole, vec2(-32768.0), vec2(32767.0))) * size;
    int x0 = wrapTexel(cell.x, size.x, wrapU);
    int x1 = wrapTexel(cell.x + 1, size.x, wrapU);
    int y0 = base + wrapTexel(cell.y, size.y, wrapV) * size.x;
    int y1 = base + wrapTexel(cell.y + 1, size.y, wrapV) * size.x;
    vec4 c00 = decodeTexel(texelFetch(texels, y0 + x0).x, srgb);
    vec4 c10 = decodeTexel(texelFetch(texels, y0 + x1).x, srgb);
    vec4 c01 = decodeTexel(texelFetch(texels, y1 + x0).x, srgb);
    vec4 c11 = decodeTexel(texelFetch(texels, y1 + x1).x, srgb);
    return mix(mix(c00, c10, f.x), mix(c01, c11, f.x), f.y);
}

// Level 0, for alpha tests and light selection, where a sharp edge matters more than aliasing.
vec4 sampleTextureSharp(uint index, vec2 uv) { return sampleTexture(index, uv, 0.0, 0.0); }

#endif
