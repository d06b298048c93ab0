#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/image/bitmap.h"
#include "engine/measure/bench_rays.h"
#include "engine/measure/hit_oracle.h"

namespace raylab {

/// Beyond this relative difference of t the oracle is asked.
constexpr double kSameT = 1e-5;
constexpr double kSameBarycentrics = 1e-4;

/// What two tracers make of one ray.
enum class RayState : uint8_t { equal, tOnly, tie, undecidable, aWrong, bWrong, bothWrong, notCompared };

struct RayStateInfo {
    RayState state;
    std::string_view color;
    std::string_view meaning;
    std::array<float, 3> rgb;  ///< linear; of `equal`, times a dim shading
};

/// In the order of RayState: the legend of the heat map.
inline constexpr std::array kRayStates = {
    RayStateInfo{RayState::equal, "grey", "the same hit", {0.12f, 0.12f, 0.12f}},
    RayStateInfo{RayState::tOnly, "blue", "the same primitive, t differs by more than 4 ulp", {0.02f, 0.12f, 0.90f}},
    RayStateInfo{RayState::tie, "green", "a tie: coplanar surfaces, a shared edge", {0.02f, 0.65f, 0.05f}},
    RayStateInfo{RayState::undecidable, "yellow", "not decidable in float: past an edge", {0.95f, 0.80f, 0.02f}},
    RayStateInfo{RayState::aWrong, "red", "A is wrong", {0.90f, 0.01f, 0.01f}},
    RayStateInfo{RayState::bWrong, "magenta", "B is wrong", {0.85f, 0.02f, 0.75f}},
    RayStateInfo{RayState::bothWrong, "white", "both are wrong", {1.0f, 1.0f, 1.0f}},
    RayStateInfo{RayState::notCompared, "black", "not compared", {0.0f, 0.0f, 0.0f}},
};

/// Counts of rays. A ray that differs in more than one way counts once among hitMiss, instance and primitive; the t of
/// any two hits are compared, barycentrics on the same primitive only.
struct DifferenceCounts {
    uint64_t rays = 0;
    uint64_t hitMiss = 0;  ///< one hits (or is occluded), the other not
    uint64_t instance = 0;
    uint64_t primitive = 0;  ///< of the same instance
    uint64_t t = 0;          ///< beyond kSameT, relative
    uint64_t tUlp1 = 0;      ///< beyond one unit in the last place
    uint64_t tUlp4 = 0;
    uint64_t barycentrics = 0;  ///< beyond kSameBarycentrics
    /// What the oracle says of all rays that differ in hit or miss, instance, primitive or t beyond kSameT.
    uint64_t aWrong = 0;
    uint64_t bWrong = 0;
    uint64_t bothWrong = 0;  ///< in neither of the two before
    uint64_t ties = 0;
    uint64_t undecidable = 0;

    void add(const DifferenceCounts& other);
    uint64_t judged() const { return aWrong + bWrong + bothWrong + ties + undecidable; }
};

struct KindCounts {
    RayKind kind;
    DifferenceCounts counts;
};

/// A ray to look at, with everything that is needed to trace it again.
struct Offender {
    std::string_view kind;
    bool anyHit = false;
    uint32_t key = 0;  ///< index in its dispatch, which decides blended alpha
    shared::RayData ray{};
    shared::HitData a{};
    shared::HitData b{};
    TrueHit truth;
    RayState state = RayState::equal;
};

struct ComparePlan {
    BenchView view;             ///< its camera, light, size and first seed
    uint64_t rays = 1'000'000;  ///< all kinds of rays, seed after seed, until so many are compared
    size_t offenders = 16;      ///< kept at most
    bool heat = false;          ///< paint RayComparison::heat
};

struct RayComparison {
    std::vector<KindCounts> kinds;
    std::vector<Offender> offenders;  ///< first those where somebody is wrong, then undecidable ones
    Bitmap heat;                      ///< primary rays of the first seed, linear; empty where it was not asked for
    bool complete = false;            ///< false: stopped before

    DifferenceCounts total() const;
};

/// Between two batches: what part is done. False stops.
using CompareProgress = std::function<bool(double fraction)>;

/// Compares what two casters say of the same rays, which are those of makeBenchRays() by A's hits. From the second seed
/// on, the camera is turned by a part of a pixel, so that no ray comes twice. Of a round of kinds that is not needed as
/// a whole, every kind gets its share.
RayComparison compareRays(HitSource& a, HitSource& b, const Scene& scene, const ComparePlan& plan,
                          const CompareProgress& progress);

}  // namespace raylab
