// Integer hashes and numbers made of their bits.
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

#endif
