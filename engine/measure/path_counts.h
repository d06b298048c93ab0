#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/image/bitmap.h"
#include "engine/measure/bench_rays.h"

namespace raylab {

/// A field of shared::RayCounts.
struct CountField {
    std::string_view name;   ///< in files
    std::string_view title;  ///< before a reader
    std::string_view help;
    shared::uint shared::RayCounts::*member;
};

inline constexpr std::array kCountFields = {
    CountField{"steps", "loop steps", "of the walk's loop", &shared::RayCounts::steps},
    CountField{"nodes", "nodes", "fetched", &shared::RayCounts::nodes},
    CountField{"boxesTested", "boxes tested", "children's boxes", &shared::RayCounts::boxesTested},
    CountField{"boxesHit", "boxes hit", "of those", &shared::RayCounts::boxesHit},
    CountField{"primitivesTested", "primitives tested",
               "triangles and quadrics; of the driver's tracers: candidates the kernel was asked about",
               &shared::RayCounts::primitivesTested},
    CountField{"primitivesHit", "primitives hit", "closer than what was known then", &shared::RayCounts::primitivesHit},
    CountField{"instances", "instances", "entered", &shared::RayCounts::instances},
    CountField{"stackHigh", "stack high-water mark", "entries of the stack in use at most", &shared::RayCounts::stackHigh},
};

/// What one bounce of an image's paths cost.
struct BounceCounts {
    std::vector<uint32_t> pixels;  ///< of each ray, y * width + x
    std::vector<shared::RayCounts> counts;
};

/// Primary rays and so many diffuse bounces, by the caster's counting kernel.
std::vector<BounceCounts> countPaths(RayCaster& caster, const Scene& scene, const BenchView& view, int bounces);

struct CountSummary {
    double mean = 0.0;
    uint32_t median = 0;
    uint32_t high = 0;  ///< 99 % of the rays are at or below
    uint32_t most = 0;
    /// [i]: rays with a count of 0 (i = 0) or of 2^(i-1) .. 2^i - 1
    std::vector<uint64_t> histogram;
};

CountSummary summarise(const BounceCounts& bounce, const CountField& field);

/// One channel; NaN where a pixel has no ray.
Bitmap countMap(const BounceCounts& bounce, const CountField& field, uint32_t width, uint32_t height);

}  // namespace raylab
