#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace raylab {

/// Settings that change how long a picture takes or how it is shown, but no sample of it.
inline constexpr std::array<std::string_view, 24> kSpeedSettings = {
    "tracer",         "builder",     "layout",         "triangle",
    "leaf-size",      "bins",        "traversal-cost", "intersection-cost",
    "spatial-budget", "reinsertion", "trees",          "flatten-limit",
    "bvh-cache",      "needs",       "time-limit",     "target-error",
    "exposure",       "tonemap",     "slice-ms",       "device",
    "validation",     "schedule",    "queue-order",    "queue-paths"};

/// Settings that change the noise of a picture, but not what it converges to.
inline constexpr std::array<std::string_view, 8> kNoiseSettings = {
    "spp", "seed", "roulette-depth", "throughput-end", "sampler", "light-choice", "adaptive", "denoise"};

inline bool isSpeedSetting(std::string_view name) {
    return std::ranges::find(kSpeedSettings, name) != kSpeedSettings.end();
}

inline bool isNoiseSetting(std::string_view name) {
    return std::ranges::find(kNoiseSettings, name) != kNoiseSettings.end();
}

}  // namespace raylab
