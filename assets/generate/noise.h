#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace raylab::assets {

/// Uniform in [0, 1), a pure function of its arguments.
float hash01(uint32_t x, uint32_t y = 0, uint32_t seed = 0);

/// Numbers for a layout, a pure function of the seed and of how many were drawn before. C++ leaves the order of a
/// call's arguments open, so at most one of them may roll; braces keep their order.
class Dice {
public:
    explicit Dice(uint32_t seed) : seed_(seed) {}
    float roll() { return hash01(count_++, 0x51ed270bu, seed_); }
    float roll(float low, float high) { return low + (high - low) * roll(); }

private:
    uint32_t seed_;
    uint32_t count_ = 0;
};

/// Gradient noise (Perlin, "Improving Noise", SIGGRAPH 2002) in about [-1, 1] that repeats after `period` cells.
float tileNoise(glm::vec2 p, glm::uvec2 period, uint32_t seed);

/// Sum of `octaves` of tileNoise over uv in [0, 1]^2, `cells` cells across at first, halving amplitude; in about [-1,
/// 1].
float tileFbm(glm::vec2 uv, glm::uvec2 cells, uint32_t octaves, uint32_t seed);

/// Gradient noise in space, not periodic, in about [-1, 1].
float noise3(glm::vec3 p, uint32_t seed);

}  // namespace raylab::assets
