// Numbers as a pure function of (seed, pixel, sample, dimension), in padded pairs of dimensions: sample2D(sampler, pair).
// The kernel holds one of four samplers (kSpecSampler):
//   sobol        shuffled, Owen-scrambled (0,2)-Sobol points. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4),
//                2020; hash of Laine and Karras 2011.
//   independent  hashes.
//   stratified   correlated multi-jittered points, Kensler, Pixar Technical Memo 13-01, 2013; any number of samples.
//   blue-noise   the Sobol points of one seed in all pixels, shifted (Cranley, Patterson 1976) by a mask of blue noise:
//                Georgiev, Fajardo, "Blue-noise Dithered Sampling", SIGGRAPH Talks 2016.
#ifndef RAYLAB_SAMPLER_GLSL
#define RAYLAB_SAMPLER_GLSL

#include "lib/convert.glsl"
#include "lib/random.glsl"
#include "lib/scene_buffers.glsl"

layout(constant_id = kSpecSampler) const uint kSampler = kSamplerSobol;

layout(set = 0, binding = kBindBlueNoise) uniform usamplerBuffer blueNoiseRanks;

struct Sampler {
    uint key;  // of (seed, pixel); blue noise: of the seed alone
    uint index;
    uvec2 pixel;
};

Sampler makeSampler(uint seed, uvec2 pixel, uint width, uint sampleIndex) {
    uint key = hashUint(seed ^ 0xa511e9b3u);
    if (kSampler != kSamplerBlueNoise) key = hashCombine(key, pixel.y * width + pixel.x);
    return Sampler(key, sampleIndex, pixel);
}

// Owen scrambling of bit-reversed x: every bit flips depending on the bits below it.
uint laineKarras(uint x, uint seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

// Second Sobol dimension, bit-reversed: the Pascal matrix mod 2 as a superset transform (Lucas' theorem).
uint sobolSecondReversed(uint index) {
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    index ^= (index >> 16) & 0x0000ffffu;
    return index;
}

uvec2 sobolPair(uint index, uint key) {
    index = bitfieldReverse(laineKarras(bitfieldReverse(index), key));
    uint x = bitfieldReverse(laineKarras(index, hashUint(key ^ 0x68bc21ebu)));
    uint y = bitfieldReverse(laineKarras(sobolSecondReversed(index), hashUint(key ^ 0x02e5be93u)));
    return uvec2(x, y);
}

vec2 unitFloat(uvec2 bits) { return vec2(unitFloat(bits.x), unitFloat(bits.y)); }

vec2 independentPair(uint index, uint key) {
    uint x = hashCombine(key, index);
    return unitFloat(uvec2(x, hashUint(x ^ 0x68bc21ebu)));
}

// The place of i < count in a permutation of 0 .. count - 1: a bijection of the numbers of as many bits (products with odd
// numbers, shifts folded in), walked until it is below count again. A turn by a random number of places makes every place of
// every i equally likely, which walking alone does not where count is no power of two. count <= 2^24.
uint permute(uint i, uint count, uint key) {
    if (count <= 1u) return 0u;
    i = min(i, count - 1u);  // a walk that starts beyond might never end
    uint mask = (2u << findMSB(count - 1u)) - 1u;
    uint shift = (uint(findMSB(count - 1u)) >> 1) + 1u;
    do {
        i = (i ^ (key >> 8)) & mask;
        i = (i * (key | 1u)) & mask;
        i ^= i >> shift;
        i = (i * ((key >> 16) | 1u)) & mask;
        i ^= i >> shift;
        i = (i * 0x846ca68bu) & mask;
        i ^= i >> shift;
    } while (i >= count);
    i += min(uint(unitFloat(hashUint(key)) * float(count)), count - 1u);
    return i >= count ? i - count : i;
}

// Samples of a pixel lie one in each column of `strataWidth` times and row of `sampleCount`, and one in each cell of the
// grid that both make.
vec2 stratifiedPair(uint index, uint key) {
    uint columns = frame.strataWidth, count = frame.sampleCount;
    uint place = permute(index, count, hashUint(key ^ 0x51ed270bu));
    ivec2 cell = divideByWidth(int(place), int(columns)).yx;
    uint rows = uint(divideByWidth(int(count + columns - 1u), int(columns)).x);
    float column = float(permute(uint(cell.x), columns, hashUint(key ^ 0x68bc21ebu)));
    float row = float(permute(uint(cell.y), rows, hashUint(key ^ 0x02e5be93u)));
    vec2 jitter = independentPair(index, key);
    vec2 at = vec2((column + (row + jitter.x) / float(rows)) / float(columns),
                   (float(place) + jitter.y) / float(count));
    return min(at, vec2(0.99999994));  // the last number below 1
}

// The mask's rank at a pixel, moved by a hash, as a fraction of 1 in fixed point.
uint blueNoise(uvec2 pixel, uint key) {
    uvec2 at = (pixel + uvec2(key, key >> 16)) & (kBlueNoiseSize - 1u);
    return texelFetch(blueNoiseRanks, int(at.y * kBlueNoiseSize + at.x)).x << (32u - kBlueNoiseRankBits);
}

// Two numbers in [0, 1) for the pair of dimensions `pair`.
vec2 sample2D(Sampler s, uint pair) {
    uint key = hashCombine(s.key, pair);
    if (kSampler == kSamplerIndependent) return independentPair(s.index, key);
    if (kSampler == kSamplerStratified) return stratifiedPair(s.index, key);
    uvec2 bits = sobolPair(s.index, key);
    if (kSampler == kSamplerBlueNoise)
        bits += uvec2(blueNoise(s.pixel, hashUint(key ^ 0x1b56c4e9u)), blueNoise(s.pixel, hashUint(key ^ 0x7feb352du)));
    return unitFloat(bits);
}

const uint kPairTime = 0x80000000u;  // beyond what camera and integrators take

// When a sample is taken: of the camera's motion and the instances'.
float sampleTime(Sampler s) { return frame.shutter * sample2D(s, kPairTime).x; }

// From here on the scene stands as the sample sees it.
void setRayTime(Sampler s) {
    if (needs(kNeedMotion)) rayTime = sampleTime(s);
}

// A key for choices inside a traversal (blended alpha): the same for every backend.
uint traceKey(Sampler s, uint pair) {
    uint key = hashCombine(hashCombine(s.key, s.index), pair);
    return kSampler == kSamplerBlueNoise ? hashCombine(key, s.pixel.y << 16 | s.pixel.x) : key;
}

#endif
