// Textures from one texel buffer: every texture of the scene is within reach of the one kernel, whatever the device's
// limit on descriptors. Filter: bilinear in linear light at one level; the level is chosen by a ray cone
// (Akenine-Moller et al., "Improved Shader and Texture Level of Detail Using Ray Cones", JCGT 10(1), 2021) and rounded at
// random, which is trilinear filtering in expectation at half its fetches.
#ifndef RAYLAB_TEXTURE_GLSL
#define RAYLAB_TEXTURE_GLSL

#include "lib/convert.glsl"
#include "lib/scene_buffers.glsl"

vec3 srgbToLinear(vec3 c) {
    return mix(c * (1.0 / 12.92), pow((c + 0.055) * (1.0 / 1.055), vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

// Texel x of the repetition `tile` of an image, -1 <= x <= size, by the wrap mode. Without an integer division, which
// takes lavapipe longer than the rest of the lookup.
int wrapTexel(int x, int tile, int size, uint mode) {
    int beyond = x < 0 ? -1 : (x >= size ? 1 : 0);
    int local = x - beyond * size;
    int reached = tile + beyond;
    if (mode == 1u) return reached < 0 ? 0 : (reached > 0 ? size - 1 : local);
    return mode == 2u && (reached & 1) != 0 ? size - 1 - local : local;
}

vec4 decodeTexel(uint packed, bool srgb) {
    vec4 c = unpackUnorm4x8(packed);
    return srgb ? vec4(srgbToLinear(c.rgb), c.a) : c;
}

// `lod`: level of detail before rounding; `u` rounds it.
vec4 sampleTexture(uint index, vec2 uv, float lod, float u) {
    uvec4 header = texelFetch(textureWords, int(index));
    uint levels = (header.w >> kTextureLevelShift) & 31u;
    uint level = uint(wholeToInt(clamp(floor(lod + u), 0.0, float(levels - 1u))));
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
    vec2 corner = floor(at);
    vec2 f = at - corner;
    ivec2 cell = wholeToInt(corner);
    ivec2 tile = wholeToInt(clamp(whole, vec2(-32768.0), vec2(32767.0)));
    int x0 = wrapTexel(cell.x, tile.x, size.x, wrapU);
    int x1 = wrapTexel(cell.x + 1, tile.x, size.x, wrapU);
    int y0 = base + wrapTexel(cell.y, tile.y, size.y, wrapV) * size.x;
    int y1 = base + wrapTexel(cell.y + 1, tile.y, size.y, wrapV) * size.x;
    vec4 c00 = decodeTexel(texelFetch(texels, y0 + x0).x, srgb);
    vec4 c10 = decodeTexel(texelFetch(texels, y0 + x1).x, srgb);
    vec4 c01 = decodeTexel(texelFetch(texels, y1 + x0).x, srgb);
    vec4 c11 = decodeTexel(texelFetch(texels, y1 + x1).x, srgb);
    return mix(mix(c00, c10, f.x), mix(c01, c11, f.x), f.y);
}

// Level 0, for alpha tests and light selection, where a sharp edge matters more than aliasing.
vec4 sampleTextureSharp(uint index, vec2 uv) { return sampleTexture(index, uv, 0.0, 0.0); }

#endif
