// Numbers as a pure function of (seed, pixel, sample, dimension): shuffled, Owen-scrambled (0,2)-Sobol points in padded
// pairs of dimensions. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020; hash of Laine and Karras 2011.
#ifndef RAYLAB_RANDOM_GLSL
#define RAYLAB_RANDOM_GLSL

// Integer finaliser with low bias (Wellons, "Prospecting for Hash Functions", 2018).
uint hashUint(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

uint hashCombine(uint a, uint b) { return hashUint(a ^ (hashUint(b) + 0x9e3779b9u + (a << 6) + (a >> 2))); }

float unitFloat(uint x) { return float(x >> 8) * 5.9604644775390625e-8; }  // [0, 1): 24 bits

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

struct Sampler {
    uint key;  // of (seed, pixel)
    uint index;
};

Sampler makeSampler(uint seed, uint pixel, uint sampleIndex) {
    return Sampler(hashCombine(hashUint(seed ^ 0xa511e9b3u), pixel), sampleIndex);
}

// Two numbers in [0, 1) for the pair of dimensions `pair`.
vec2 sample2D(Sampler s, uint pair) {
    uint key = hashCombine(s.key, pair);
    uint index = bitfieldReverse(laineKarras(bitfieldReverse(s.index), key));
    uint x = bitfieldReverse(laineKarras(index, hashUint(key ^ 0x68bc21ebu)));
    uint y = bitfieldReverse(laineKarras(sobolSecondReversed(index), hashUint(key ^ 0x02e5be93u)));
    return vec2(unitFloat(x), unitFloat(y));
}

// A key for choices inside a traversal (blended alpha): the same for every backend.
uint traceKey(Sampler s, uint pair) { return hashCombine(hashCombine(s.key, s.index), pair); }

#endif
